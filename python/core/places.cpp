#include "python/core/places.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <span>

#include "radar/private_data.hpp"

namespace yars::python {

Terrain::Terrain(const std::string& directory)
    : lock_([this] {
        if (terrain_) terrain_->stores()->renew();
      }) {
  without_interpreter([&](const parallel::GoesOn&) {
    terrain_ = std::make_unique<yars::Terrain>(value_of(yars::Terrain::open({directory})));
  });
  terrain_->stores()->use_lock([this](const parallel::GoesOn& goes_on) {
    return std::make_shared<std::unique_lock<std::timed_mutex>>(lock_.take(goes_on));
  });
}

py::array Terrain::elevation(const Numbers& latitudes, const Numbers& longitudes) {
  py::array_t<double> heights(std::vector<py::ssize_t>(latitudes.shape(), latitudes.shape() + latitudes.ndim()));
  const auto count = static_cast<std::size_t>(latitudes.size());
  const std::span<const double> latitude{latitudes.data(), count}, longitude{longitudes.data(), count};
  const std::span<double> height{heights.mutable_data(), count};
  Warnings warnings;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    check_done(terrain_->elevations(latitude, longitude, height, warnings.call(goes_on)));
  });
  warnings.show("yars.Terrain.elevation");
  return heights;
}

Scene::Scene(const std::vector<std::string>& files, std::shared_ptr<Terrain> terrain,
             const std::vector<std::string>& without)
    : terrain_(std::move(terrain)) {
  Warnings warnings;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    scene_ = std::make_unique<yars::Scene>(
        value_of(yars::Scene::read(files, terrain_->terrain(), without, warnings.call(goes_on))));
  });
  warnings.show("yars.Scene", 3);
}

py::array Scene::object_table() const {
  std::size_t longest = 1;
  for (const SceneObject& object : scene_->objects()) longest = std::max(longest, object.name.size());
  py::list numbers;
  for (const SceneObject& object : scene_->objects())
    numbers.append(py::make_tuple(object.name, object.latitude_deg, object.longitude_deg, object.base_msl_m,
                                  object.height_m, object.length_m, object.width_m, object.heading_deg,
                                  object.material));
  py::list fields;
  fields.append(py::make_tuple("name", "U" + std::to_string(longest)));
  for (const char* field : {"latitude", "longitude", "base_msl_m", "height_m", "length_m", "width_m", "heading_deg"})
    fields.append(py::make_tuple(field, "f8"));
  fields.append(py::make_tuple("material", "u1"));
  return py::module_::import("numpy").attr("array")(numbers, fields);
}

void add_places(py::module_& module) {
  py::class_<Terrain, std::shared_ptr<Terrain>> terrain(module, "Terrain");
  terrain.def("elevation", &Terrain::elevation, py::arg("latitude"), py::arg("longitude"));
  seal(terrain);
  py::class_<Scene, std::shared_ptr<Scene>> scene(module, "Scene");
  scene.def_property_readonly("triangles", [](const Scene& one) { return one.scene().triangles(); })
      .def_property_readonly("objects", &Scene::object_table);
  seal(scene);
  module.def("open_terrain", [](const std::string& directory) { return std::make_shared<Terrain>(directory); });
  module.def("read_scene", [](const std::vector<std::string>& files, std::shared_ptr<Terrain> given,
                              const std::vector<std::string>& without) {
    return std::make_shared<Scene>(files, std::move(given), without);
  });
}

}  // namespace yars::python
