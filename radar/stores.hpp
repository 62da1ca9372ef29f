// Data of a Terrain and a Scene: stores that stay open, and footprints of objects.
// Threads: Terrain::Stores serves one call at a time; a lock makes others wait.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "radar/failure.hpp"
#include "radar/theatre.hpp"
#include "yars/scene.hpp"
#include "yars/terrain.hpp"

namespace yars {

class Terrain::Stores {
 public:
  explicit Stores(radar::TerrainConfiguration configuration) : configuration_(std::move(configuration)) {}

  const radar::TerrainConfiguration& configuration() const { return configuration_; }

  // Returns work(theatre). `theatre`: that of these scenes and this use, opened at the first call. After a Failure the
  // next call reads the files again. Throws parallel::Stopped.
  template <class Work>
  auto with_theatre(const std::vector<radar::Scene>& scenes, model::scene::SceneUse use,
                    const parallel::GoesOn& goes_on, const Work& work) {
    const std::shared_ptr<void> taken = take_ ? take_(goes_on) : std::make_shared<std::unique_lock<std::mutex>>(mutex_);
    parallel::check(goes_on);
    const std::string key = key_of(scenes, use);
    try {
      std::unique_ptr<radar::Theatre>& theatre = (*theatres_)[key];
      if (!theatre) theatre = std::make_unique<radar::Theatre>(configuration_, scenes, use);
      return work(*theatre);
    } catch (const radar::Failure&) {
      theatres_->erase(key);
      throw;
    }
  }

  // For a host with fork(). `take` gives the lock that replaces that of the stores, and throws parallel::Stopped;
  // renew() leaves the stores of a child, in which another thread's call never ends, to themselves.
  using Take = std::function<std::shared_ptr<void>(const parallel::GoesOn&)>;
  void use_lock(Take take) { take_ = std::move(take); }
  void renew() {
    static_cast<void>(theatres_.release());
    theatres_ = std::make_unique<Theatres>();
  }

 private:
  static std::string key_of(const std::vector<radar::Scene>& scenes, model::scene::SceneUse use);

  using Theatres = std::map<std::string, std::unique_ptr<radar::Theatre>>;
  radar::TerrainConfiguration configuration_;
  std::mutex mutex_;
  Take take_;  // empty: the lock of mutex_
  std::unique_ptr<Theatres> theatres_ = std::make_unique<Theatres>();
};

namespace radar {

// Footprint of an object on the plane of its group: azimuthal equidistant about the group's origin.
struct Footprint {
  std::int32_t object = 0;  // index into Scene::objects()
  double east_m = 0.0, north_m = 0.0;
  double half_length_m = 0.0, half_width_m = 0.0;
  double heading_deg = 0.0;         // of the length, clockwise from the plane's north
  double sine = 0.0, cosine = 1.0;  // of the heading
  double base_msl_m = 0.0;
};

// Objects about 1 km around an origin, so that one linear transform places all of them on a map.
struct FootprintGroup {
  geo::GeoPoint origin;
  std::vector<Footprint> footprints;
  double reach_m = 0.0;  // from the origin to the farthest corner
};

// Index of the object whose box, seen from above, contains a position; -1: none. Of several the last one.
std::int32_t object_at(const std::vector<FootprintGroup>& groups, geo::GeoPoint position);

// Throws Failure for a scene that was read for another folder of terrain: its objects stand at other heights there. Two
// names of one folder are the same terrain. Null: no scene.
void check_same_terrain(const yars::Scene* scene, const Terrain& terrain);

}  // namespace radar

struct Scene::Parts {
  Terrain terrain;
  std::vector<radar::Scene> scenes;
  std::vector<SceneObject> objects;
  std::vector<radar::FootprintGroup> groups;
  std::size_t triangles = 0;
};

}  // namespace yars
