// Classes Terrain and Scene of the Python module: elevation and scenes that scans and maps are computed from. Both stay
// in memory for later calls.
// Units: degrees, metres.
// Threads: a Terrain and its Scenes serve one call at a time; a lock makes others wait.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/world.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "python/core/calls.hpp"
#include "python/core/support.hpp"
#include "tools/command/theatre.hpp"

namespace yars::python {

// Footprint of an object on the plane of its group: azimuthal equidistant about the group's origin.
struct Footprint {
  std::int32_t object = 0;  // index into SceneView::objects()
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

struct CellPositions;

class Terrain {
 public:
  // `directory`: folder of elevation cells; empty: the built-in hills. Throws CommandFailed.
  explicit Terrain(const std::string& directory);

  const std::string& directory() const { return configuration_.directory; }
  const radar::TerrainConfiguration& configuration() const { return configuration_; }
  // [m MSL] at positions in degrees, arrays of equal shape. NaN: void.
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  py::array elevation(const Numbers& latitude_deg, const Numbers& longitude_deg);

  // What work(theatre) gives, with the theatre of these scenes and this use, which is opened when first asked for. A
  // failure has its reasons from `warnings` in its message, and the files are read anew next time.
  template <class Work>
  auto with_theatre(const std::vector<radar::Scene>& scenes, model::scene::SceneUse use, Warnings& warnings,
                    const parallel::GoesOn& goes_on, const Work& work) {
    const auto taken = lock_.take(goes_on);
    try {
      return work(theatre(scenes, use));
    } catch (tools::CommandFailed& failed) {
      warnings.explain(failed);
      theatres_->erase(key_of(scenes, use));
      throw;
    }
  }

 private:
  static std::string key_of(const std::vector<radar::Scene>& scenes, model::scene::SceneUse use);
  // Call with lock_ taken.
  tools::Theatre& theatre(const std::vector<radar::Scene>& scenes, model::scene::SceneUse use);

  void fill_elevations(const CellPositions& cells, double* height_m, Warnings& warnings,
                       const parallel::GoesOn& goes_on);

  using Theatres = std::map<std::string, std::unique_ptr<tools::Theatre>>;

  radar::TerrainConfiguration configuration_;
  std::unique_ptr<Theatres> theatres_ = std::make_unique<Theatres>();
  ObjectLock lock_{[this] { static_cast<void>(theatres_.release()), theatres_ = std::make_unique<Theatres>(); }};
};

class Scene {
 public:
  // `files`: FILE or FILE@LAT,LON,HDG. `without`: names of parts to leave out. Reads all files. Throws CommandFailed.
  Scene(const std::vector<std::string>& files, std::shared_ptr<Terrain> terrain,
        const std::vector<std::string>& without);

  const std::shared_ptr<Terrain>& terrain() const { return terrain_; }
  const std::vector<radar::Scene>& scenes() const { return scenes_; }
  const std::vector<model::scene::SceneObject>& objects() const { return view_->objects(); }
  const std::vector<FootprintGroup>& groups() const { return groups_; }
  std::size_t triangles() const { return triangles_; }
  py::array object_table() const;  // structured array

 private:
  std::shared_ptr<Terrain> terrain_;
  std::vector<radar::Scene> scenes_;
  model::scene::SceneViewPointer view_;
  std::vector<FootprintGroup> groups_;
  std::size_t triangles_ = 0;
};

// Throws ValueError for a scene that was read for another folder of terrain: its objects stand at other heights there.
// Two names of one folder are the same terrain. Null: no scene.
void check_same_terrain(const Scene* scene, const Terrain& terrain);

void add_places(py::module_& module);

}  // namespace yars::python
