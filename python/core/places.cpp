#include "python/core/places.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

#include "lib/geo/earth.hpp"
#include "model/scene/index/scene_index.hpp"
#include "tools/command/command.hpp"

namespace yars::python {

using model::scene::SceneObject;
using model::scene::SceneUse;

Terrain::Terrain(const std::string& directory) {
  configuration_.directory = directory;
  theatre({}, SceneUse::scatterers);  // reports a missing or unusable folder at once
}

tools::Theatre& Terrain::theatre(const std::vector<radar::Scene>& scenes, SceneUse use) {
  std::string key = use == SceneUse::triangles ? "maps" : "scans";
  for (const radar::Scene& scene : scenes)
    key += '\n' + scene.file + '@' + std::to_string(scene.position.latitude_deg) + ',' +
           std::to_string(scene.position.longitude_deg) + ',' + std::to_string(scene.heading_deg) + ',' + scene.without;
  std::unique_ptr<tools::Theatre>& theatre = theatres_[key];
  if (!theatre) theatre = std::make_unique<tools::Theatre>(configuration_, scenes, use);
  return *theatre;
}

namespace {

// Fills in elevations, cell by cell. One view serves all positions of a cell but those near its edges.
void fill_elevations(tools::Theatre& theatre, std::span<const double> latitude_deg,
                     std::span<const double> longitude_deg, double* height_m, const tools::Warn& warn) {
  constexpr double kNear_m = 100.0, kEdge_deg = 0.001;
  const auto cell_of = [&](std::size_t i) {
    return static_cast<int>(std::floor(latitude_deg[i])) * 400 + static_cast<int>(std::floor(longitude_deg[i]));
  };
  std::vector<std::size_t> order(latitude_deg.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, cell_of);
  const auto at_edge = [](double part, double margin_deg) { return part < margin_deg || part > 1.0 - margin_deg; };
  model::terrain::TerrainViewPointer view;
  int cell_of_view = 0;
  for (const std::size_t i : order) {
    const geo::GeoPoint position{latitude_deg[i], longitude_deg[i]};
    const double east_deg = kEdge_deg / std::max(std::cos(position.latitude_deg * geo::kRadiansPerDegree), 1e-6);
    const bool alone = at_edge(position.latitude_deg - std::floor(position.latitude_deg), kEdge_deg) ||
                       at_edge(position.longitude_deg - std::floor(position.longitude_deg), east_deg);
    const bool fits = view && !alone && cell_of_view == cell_of(i);
    if (!fits) view = theatre.terrain_near(position, kNear_m, warn);
    height_m[i] = view->elevation_m(position);
    cell_of_view = cell_of(i);
    if (alone) view = nullptr;
  }
}

}  // namespace

py::array Terrain::elevation(const py::object& latitude_deg, const py::object& longitude_deg) {
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const py::sequence pair = py::module_::import("numpy").attr("broadcast_arrays")(latitude_deg, longitude_deg);
  const Numbers latitudes = Numbers::ensure(pair[0]), longitudes = Numbers::ensure(pair[1]);
  if (!latitudes || !longitudes) {
    PyErr_Clear();
    raise_value_error("yars.Terrain.elevation: expected numbers of degrees, found others");
  }
  py::array_t<double> heights(std::vector<py::ssize_t>(latitudes.shape(), latitudes.shape() + latitudes.ndim()));
  const double* const latitude = latitudes.data();
  const double* const longitude = longitudes.data();
  double* const height_m = heights.mutable_data();
  const auto count = static_cast<std::size_t>(latitudes.size());
  for (std::size_t i = 0; i < count; ++i)
    if (!(std::abs(latitude[i]) <= 90.0) || !(std::abs(longitude[i]) <= 180.0))
      raise_value_error(
          "yars.Terrain.elevation: expected latitudes from -90 to 90 and longitudes from -180 to 180, found " +
          std::to_string(latitude[i]) + ", " + std::to_string(longitude[i]));
  Warnings warnings;
  {
    const py::gil_scoped_release released;
    const std::lock_guard guard(mutex_);
    fill_elevations(theatre({}, SceneUse::scatterers), {latitude, count}, {longitude, count}, height_m,
                    warnings.sink());
  }
  warnings.show("yars.Terrain");
  return heights;
}

namespace {

// Groups the objects by squares of about 1 km. The object of the faces outside objects has no name and is left out.
std::vector<FootprintGroup> groups_of(const std::vector<SceneObject>& objects) {
  constexpr double kSide_deg = 0.01;
  std::map<std::pair<long, long>, FootprintGroup> groups;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const SceneObject& object = objects[i];
    if (object.name.empty() || !(object.length_m > 0.0)) continue;
    const double across_deg = kSide_deg / std::max(std::cos(object.middle.latitude_deg * geo::kRadiansPerDegree), 0.05);
    const std::pair key{std::lround(object.middle.latitude_deg / kSide_deg),
                        std::lround(object.middle.longitude_deg / across_deg)};
    FootprintGroup& group = groups[key];
    if (group.footprints.empty()) group.origin = object.middle;
    const geo::PlanePoint at = geo::AzimuthalEquidistant(group.origin).plane_from_geodetic(object.middle);
    const double heading_rad = object.heading_deg * geo::kRadiansPerDegree;
    group.footprints.push_back({static_cast<std::int32_t>(i), at.x_m, at.y_m, 0.5 * object.length_m,
                                0.5 * object.width_m, object.heading_deg, std::sin(heading_rad), std::cos(heading_rad),
                                object.base_msl_m});
    group.reach_m = std::max(group.reach_m, std::hypot(at.x_m, at.y_m) + std::hypot(object.length_m, object.width_m));
  }
  std::vector<FootprintGroup> list;
  list.reserve(groups.size());
  for (auto& [key, group] : groups) list.push_back(std::move(group));
  return list;
}

}  // namespace

Scene::Scene(const std::vector<std::string>& files, std::shared_ptr<Terrain> terrain,
             const std::vector<std::string>& without)
    : files_(files), without_(without), terrain_(std::move(terrain)) {
  if (auto added = model::scene::add_scenes(scenes_, files, without); !added) raise(error::usage_error(added.error()));
  std::vector<std::string> problems;
  const auto index = model::scene::index_scenes(scenes_, problems);
  if (!index) raise(index.error());
  Warnings warnings;
  for (const std::string& problem : problems) warnings.sink()(problem);
  {
    const py::gil_scoped_release released;
    const std::lock_guard guard(terrain_->mutex());
    tools::Theatre& theatre = terrain_->theatre(scenes_, SceneUse::triangles);
    for (const model::scene::IndexedScene& scene : *index)
      view_ = theatre.scenes_near(scene.placement.position, scene.reach_m, warnings.sink());
    std::set<const model::scene::Tile*> counted;
    std::vector<const model::scene::Tile*> tiles;
    for (const model::scene::IndexedScene& scene : *index) {
      view_->tiles_near(scene.placement.position, scene.reach_m, tiles);
      for (const model::scene::Tile* tile : tiles)
        if (counted.insert(tile).second) triangles_ += tile->triangles();
    }
  }
  warnings.show("yars.Scene");
  if (!view_) raise_value_error("yars.Scene: expected a scene file, found none");
  groups_ = groups_of(view_->objects());
}

py::array Scene::object_table() const {
  std::size_t longest = 1;
  for (const SceneObject& object : objects()) longest = std::max(longest, object.name.size());
  py::list names, numbers;
  for (const SceneObject& object : objects()) {
    numbers.append(py::make_tuple(object.name, object.middle.latitude_deg, object.middle.longitude_deg,
                                  object.base_msl_m, object.height_m, object.length_m, object.width_m,
                                  object.heading_deg, view_->kinds()[object.kind].material));
  }
  py::list fields;
  fields.append(py::make_tuple("name", "U" + std::to_string(longest)));
  for (const char* field : {"latitude", "longitude", "base_msl_m", "height_m", "length_m", "width_m", "heading_deg"})
    fields.append(py::make_tuple(field, "f8"));
  fields.append(py::make_tuple("material", "u1"));
  return py::module_::import("numpy").attr("array")(numbers, fields);
}

void check_same_terrain(const Scene* scene, const Terrain& terrain) {
  if (scene == nullptr || scene->terrain()->directory() == terrain.directory()) return;
  const auto name_of = [](const Terrain& one) {
    return one.directory().empty() ? "the built-in hills" : '\'' + one.directory() + '\'';
  };
  raise_value_error("scene: expected a scene on the terrain of this call, " + name_of(terrain) + ", found one on " +
                    name_of(*scene->terrain()) + "; make a Scene with this terrain");
}

void add_places(py::module_& module) {
  py::class_<Terrain, std::shared_ptr<Terrain>>(module, "Terrain",
                                                R"(Elevation, and the scenes in its folder.

Terrain(directory=None): folder of elevation cells (DTED, HGT, DED, packs, rasters); None: the built-in hills.
What has been read stays in memory for later scans and maps, up to 512 MiB for each use.
Errors: yars.Error for a folder that is missing or has no cell.)")
      .def(py::init([](const py::object& directory) {
             return std::make_shared<Terrain>(
                 directory.is_none() ? std::string()
                                     : py::cast<std::string>(py::module_::import("os").attr("fspath")(directory)));
           }),
           py::arg("directory") = py::none())
      .def("__reduce__",
           [](const py::object& self) {
             const auto& directory = py::cast<const Terrain&>(self).directory();
             return py::make_tuple(py::type::of(self),
                                   py::make_tuple(directory.empty() ? py::object(py::none()) : py::str(directory)));
           })
      .def_property_readonly("directory", &Terrain::directory, "Folder of the cells; empty: the built-in hills.")
      .def("elevation", &Terrain::elevation, py::arg("latitude"), py::arg("longitude"),
           "Elevation [m] above mean sea level at positions [deg], bilinear between posts of the finest level.\n\n"
           "latitude, longitude: numbers or arrays that broadcast; result: float64 of their shape, NaN where void.");
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene", R"(Polygonal scenes on a terrain.

Scene(files, terrain, without=()): files, one or a list: FILE or FILE@LAT,LON,HDG (OpenFlight), or a folder of them.
without: names of objects or groups to leave out, with the wildcards * and ?.
Errors: ValueError for a text that is no scene, yars.Error for a file that cannot be read.)")
      .def(py::init([](const py::object& files, std::shared_ptr<Terrain> terrain, const py::object& without) {
             const auto texts = [](const py::object& given) {
               std::vector<std::string> list;
               const py::object fspath = py::module_::import("os").attr("fspath");
               if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"))
                 list.push_back(py::cast<std::string>(fspath(given)));
               else
                 for (const py::handle& entry : given) list.push_back(py::cast<std::string>(fspath(entry)));
               return list;
             };
             return std::make_shared<Scene>(texts(files), std::move(terrain), texts(without));
           }),
           py::arg("files"), py::arg("terrain").none(false), py::arg("without") = py::tuple())
      .def("__reduce__",
           [](const py::object& self) {
             const auto& scene = py::cast<const Scene&>(self);
             return py::make_tuple(py::type::of(self), py::make_tuple(scene.files(), scene.terrain(), scene.without()));
           })
      .def("__repr__",
           [](const Scene& scene) {
             return "<yars.Scene " + std::to_string(scene.objects().size()) + " objects, " +
                    std::to_string(scene.triangles()) + " triangles>";
           })
      .def_property_readonly("terrain", &Scene::terrain, "The Terrain that the scene was read for.")
      .def_property_readonly("triangles", &Scene::triangles, "Number of triangles of all files.")
      .def_property_readonly("objects", &Scene::object_table, R"(Structured array of all objects, shape (objects,).

name; latitude, longitude [deg] of the middle; base_msl_m [m MSL]; height_m; length_m, width_m of the box of least area
seen from above; heading_deg true of its longer side, [0, 180); material: DFAD code of most of its surface. The labels of
maps are indices into this array. The first object of each file has its faces outside objects, and no name.)");
}

}  // namespace yars::python
