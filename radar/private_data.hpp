// Private data of the public classes. Terrain and Scene: stores that stay open, and footprints of objects. Scan and
// Patch: configuration, request, environment, and the computation or its result.
// Threads: Terrain::Stores serves one call at a time; a lock makes others wait.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/kernel/offline_scan.hpp"
#include "radar/limits.hpp"
#include "radar/theatre.hpp"
#include "yars/patch.hpp"
#include "yars/scan.hpp"
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

struct Scan::Work {
  radar::RadarConfiguration configuration;
  model::kernel::ScanRequest request;
  int threads = 1;
  std::optional<Scene> scene;
  radar::ScanEnvironment environment;
  std::vector<std::string> left_out;
  std::unique_ptr<model::kernel::OfflineScan> scan;  // null: before run(), and after finish()
  model::kernel::OfflineScan::Result result;         // after finish()
  std::size_t rays = 0;                              // after finish()
  std::optional<ScanLabels> labels;

  // The computation, made at the first call.
  model::kernel::OfflineScan& ready();
  std::span<const databuffer::Sweep> sweeps() const { return scan ? scan->sweeps() : std::span(result.sweeps); }
  std::span<const model::kernel::SweepHeader> headers() const {
    return scan ? scan->headers() : std::span(result.headers);
  }
  std::span<const float> power() const { return scan ? scan->power() : std::span<const float>(result.power); }
  std::vector<radar::RaySample> ray_samples(const parallel::GoesOn& goes_on = {}) const {
    return radar::ray_samples(configuration, headers(), *environment.terrain, goes_on);
  }
};

struct Patch::Work {
  Work(const radar::RadarConfiguration& given, std::size_t threads, LabelUse labels);

  // The computation. ready() makes it at the first call, and again after finish().
  struct Formation {
    Formation(const radar::RadarConfiguration& configuration, std::size_t threads, LabelUse labels);
    parallel::ThreadPool workers;
    model::hrm::PatchFormation map;
  };
  Formation& ready();
  // Checks the order and reads what it needs.
  void prepare(const Terrain& terrain, const PatchRequest& request, const PatchSubject& subject, const Call& call);
  const model::hrm::MapImage& image() const { return formation ? formation->map.image() : result->image; }
  const std::vector<std::uint8_t>& picture() const { return formation ? formation->map.picture() : result->picture; }
  const model::hrm::PixelLabels& labels() const { return formation ? formation->map.labels() : result->labels; }

  radar::RadarConfiguration configuration;
  std::size_t threads;
  LabelUse label_use;
  model::hrm::PatchOrder order;
  model::hrm::PatchEnvironment environment;
  std::vector<std::string> left_out;
  std::unique_ptr<Formation> formation;  // null after finish()
  // After run().
  std::optional<model::hrm::PatchGeometry> geometry;
  double formation_s = 0.0;
  std::size_t triangles = 0;
  std::optional<model::hrm::PatchFormation::Result> result;  // after finish()
};

}  // namespace yars
