#include "python/core/places.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <span>

#include "lib/geo/earth.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/index/scene_index.hpp"
#include "tools/command/command.hpp"

namespace yars::python {

using model::scene::SceneObject;
using model::scene::SceneUse;

Terrain::Terrain(const std::string& directory) {
  configuration_.directory = directory;
  // Reports a missing or unusable folder at once.
  without_interpreter([this](const parallel::GoesOn&) { theatre({}, SceneUse::scatterers); });
}

std::string Terrain::key_of(const std::vector<radar::Scene>& scenes, SceneUse use) {
  std::string key = use == SceneUse::triangles ? "maps" : "scans";
  for (const radar::Scene& scene : scenes)
    key += '\n' + scene.file + '@' + std::to_string(scene.position.latitude_deg) + ',' +
           std::to_string(scene.position.longitude_deg) + ',' + std::to_string(scene.heading_deg) + ',' + scene.without;
  return key;
}

tools::Theatre& Terrain::theatre(const std::vector<radar::Scene>& scenes, SceneUse use) {
  std::unique_ptr<tools::Theatre>& theatre = (*theatres_)[key_of(scenes, use)];
  if (!theatre) theatre = std::make_unique<tools::Theatre>(configuration_, scenes, use);
  return *theatre;
}

// Positions with the cells of a folder in which they lie.
struct CellPositions {
  std::vector<geo::GeoPoint> positions;
  std::vector<std::size_t> order;  // of the positions, cell by cell
  std::size_t outside = 0;         // positions in no cell
};

namespace {

CellPositions cells_of(const model::terrain::DirectoryIndex* index, std::span<const double> latitude_deg,
                       std::span<const double> longitude_deg, const parallel::GoesOn& goes_on) {
  constexpr std::size_t kBetweenChecks = 1U << 16U;
  CellPositions cells;
  cells.positions.resize(latitude_deg.size());
  std::map<std::size_t, std::vector<std::size_t>> by_cell;
  for (std::size_t i = 0; i < cells.positions.size(); ++i) {
    if (i % kBetweenChecks == 0) parallel::check(goes_on);
    geo::GeoPoint& position = cells.positions[i] = {latitude_deg[i], longitude_deg[i]};
    if (index != nullptr) position = within_index(*index, position);
    by_cell[slot_of(model::terrain::cell_containing(position))].push_back(i);
  }
  cells.order.reserve(cells.positions.size());
  for (const auto& [slot, members] : by_cell) {
    if (index != nullptr && !index->contains(slot)) cells.outside += members.size();
    cells.order.insert(cells.order.end(), members.begin(), members.end());
  }
  return cells;
}

}  // namespace

void Terrain::fill_elevations(const CellPositions& cells, double* height_m, Warnings& warnings,
                              const parallel::GoesOn& goes_on) {
  constexpr std::size_t kChunk = 1U << 16U;  // positions between two calls of `goes_on`
  model::terrain::TerrainViewPointer view;
  std::optional<model::terrain::CellCorner> cell_of_view;
  for (std::size_t first = 0; first < cells.order.size(); first += kChunk) {
    parallel::check(goes_on);
    with_theatre({}, SceneUse::scatterers, warnings, goes_on, [&](tools::Theatre& opened) {
      for (std::size_t k = first; k < std::min(first + kChunk, cells.order.size()); ++k) {
        const geo::GeoPoint position = cells.positions[cells.order[k]];
        const model::terrain::CellCorner cell = model::terrain::cell_containing(position);
        // On an edge of the cell, a neighbour may have the height (CellView).
        const bool on_edge = position.latitude_deg == std::floor(position.latitude_deg) ||
                             position.longitude_deg == std::floor(position.longitude_deg);
        if (!view || !(cell_of_view == cell) || on_edge) view = opened.terrain_at(position, warnings.sink());
        cell_of_view = cell;
        height_m[cells.order[k]] = view->elevation_m(position);
      }
    });
  }
}

py::array Terrain::elevation(const Numbers& latitudes, const Numbers& longitudes) {
  py::array_t<double> heights(std::vector<py::ssize_t>(latitudes.shape(), latitudes.shape() + latitudes.ndim()));
  const std::span latitude{latitudes.data(), static_cast<std::size_t>(latitudes.size())};
  const std::span longitude{longitudes.data(), static_cast<std::size_t>(longitudes.size())};
  double* const height_m = heights.mutable_data();
  for (std::size_t i = 0; i < latitude.size(); ++i)
    if (!tools::kLatitudes_deg.contain(latitude[i]) || !tools::kLongitudes_deg.contain(longitude[i]))
      raise_value_error(
          "yars.Terrain.elevation: expected latitudes from -90 to 90 and longitudes from -180 to 180, found " +
          text::text_of_number(latitude[i]) + ", " + text::text_of_number(longitude[i]));
  Warnings warnings;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const auto* const index = with_theatre({}, SceneUse::scatterers, warnings, goes_on,
                                           [](const tools::Theatre& opened) { return opened.index(); });
    const CellPositions cells = cells_of(index, latitude, longitude, goes_on);
    if (cells.outside > 0)
      warnings.sink()(directory() + ": expected positions in its cells, found " + std::to_string(cells.outside) +
                      " of " + std::to_string(latitude.size()) + " outside: the folder covers " +
                      coverage_text(*index) + "; the ground there counts as sea; check the positions and their signs");
    fill_elevations(cells, height_m, warnings, goes_on);
  });
  warnings.show("yars.Terrain.elevation");
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
    : terrain_(std::move(terrain)) {
  if (auto added = model::scene::add_scenes(scenes_, files, without); !added) raise(error::usage_error(added.error()));
  Warnings warnings;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    std::vector<std::string> problems;
    const auto index = model::scene::index_scenes(scenes_, problems);
    if (!index) raise(index.error());
    for (const std::string& problem : problems) warnings.sink()(problem);
    terrain_->with_theatre(scenes_, SceneUse::triangles, warnings, goes_on, [&](tools::Theatre& theatre) {
      for (const model::scene::IndexedScene& scene : *index)
        view_ = theatre.scenes_near(scene.placement.position, scene.reach_m, warnings.sink());
      std::set<const model::scene::Tile*> counted;
      std::vector<const model::scene::Tile*> tiles;
      for (const model::scene::IndexedScene& scene : *index) {
        view_->tiles_near(scene.placement.position, scene.reach_m, tiles);
        for (const model::scene::Tile* tile : tiles)
          if (counted.insert(tile).second) triangles_ += tile->triangles();
      }
    });
  });
  warnings.show("yars.Scene", 3);
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
  std::error_code none;  // of a folder that is gone
  if (!terrain.directory().empty() &&
      std::filesystem::equivalent(scene->terrain()->directory(), terrain.directory(), none))
    return;
  const auto name_of = [](const Terrain& one) {
    return one.directory().empty() ? "the built-in hills" : '\'' + one.directory() + '\'';
  };
  raise_value_error("scene: expected a scene on the terrain of this call, " + name_of(terrain) + ", found one on " +
                    name_of(*scene->terrain()) + "; make a Scene with this terrain");
}

void add_places(py::module_& module) {
  py::class_<Terrain, std::shared_ptr<Terrain>> terrain(module, "Terrain");
  terrain.def("elevation", &Terrain::elevation, py::arg("latitude"), py::arg("longitude"));
  seal(terrain);
  py::class_<Scene, std::shared_ptr<Scene>> scene(module, "Scene");
  scene.def_property_readonly("triangles", &Scene::triangles).def_property_readonly("objects", &Scene::object_table);
  seal(scene);
  module.def("open_terrain", [](const std::string& directory) { return std::make_shared<Terrain>(directory); });
  module.def("read_scene", [](const std::vector<std::string>& files, std::shared_ptr<Terrain> given,
                              const std::vector<std::string>& without) {
    return std::make_shared<Scene>(files, std::move(given), without);
  });
}

}  // namespace yars::python
