// Classes Terrain and Scene of the Python module: yars::Terrain and yars::Scene with NumPy arrays in their interface.
// Units: degrees, metres.
// Threads: a Terrain and its Scenes serve one call at a time; a lock makes others wait.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python/core/calls.hpp"
#include "python/core/support.hpp"
#include "yars/scene.hpp"
#include "yars/terrain.hpp"

namespace yars::python {

class Terrain {
 public:
  // `directory`: folder of elevation cells; empty: the built-in hills. Throws yars::Error.
  explicit Terrain(const std::string& directory);

  const yars::Terrain& terrain() const { return *terrain_; }
  // Elevations [m MSL] at positions [deg]. All three arrays have the same shape. NaN: void.
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  py::array elevation(const Numbers& latitude_deg, const Numbers& longitude_deg);

 private:
  std::unique_ptr<yars::Terrain> terrain_;
  ObjectLock lock_;
};

class Scene {
 public:
  // `files`: FILE or FILE@LAT,LON,HDG. `without`: names of parts to leave out. Reads all files. Throws yars::Error.
  Scene(const std::vector<std::string>& files, std::shared_ptr<Terrain> terrain,
        const std::vector<std::string>& without);

  const yars::Scene& scene() const { return *scene_; }
  py::array object_table() const;  // structured array

 private:
  std::shared_ptr<Terrain> terrain_;
  std::unique_ptr<yars::Scene> scene_;
};

void add_places(py::module_& module);

}  // namespace yars::python
