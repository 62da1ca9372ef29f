#include "yars/scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "lib/geo/geodesy.hpp"
#include "model/scene/index/scene_index.hpp"
#include "radar/limits.hpp"
#include "radar/private_data.hpp"

namespace yars {

namespace {

// Groups the objects by squares of about 1 km. The object of the faces outside objects has no name and is left out.
std::vector<radar::FootprintGroup> groups_of(const std::vector<SceneObject>& objects) {
  constexpr double kSide_deg = 0.01;
  std::map<std::pair<long, long>, radar::FootprintGroup> groups;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const SceneObject& object = objects[i];
    if (object.name.empty() || !(object.length_m > 0.0)) continue;
    const geo::GeoPoint middle{object.latitude_deg, object.longitude_deg};
    const double across_deg = kSide_deg / std::max(std::cos(middle.latitude_deg * geo::kRadiansPerDegree), 0.05);
    radar::FootprintGroup& group =
        groups[{std::lround(middle.latitude_deg / kSide_deg), std::lround(middle.longitude_deg / across_deg)}];
    if (group.footprints.empty()) group.origin = middle;
    const geo::PlanePoint at = geo::AzimuthalEquidistant(group.origin).plane_from_geodetic(middle);
    const double heading_rad = object.heading_deg * geo::kRadiansPerDegree;
    group.footprints.push_back({static_cast<std::int32_t>(i), at.x_m, at.y_m, 0.5 * object.length_m,
                                0.5 * object.width_m, object.heading_deg, std::sin(heading_rad), std::cos(heading_rad),
                                object.base_msl_m});
    group.reach_m = std::max(group.reach_m, std::hypot(at.x_m, at.y_m) + std::hypot(object.length_m, object.width_m));
  }
  std::vector<radar::FootprintGroup> list;
  list.reserve(groups.size());
  for (auto& [key, group] : groups) list.push_back(std::move(group));
  return list;
}

std::vector<SceneObject> objects_of(const model::scene::SceneView& view) {
  std::vector<SceneObject> objects;
  for (const model::scene::SceneObject& object : view.objects())
    objects.push_back({object.name, object.middle.latitude_deg, object.middle.longitude_deg, object.base_msl_m,
                       object.height_m, object.length_m, object.width_m, object.heading_deg,
                       view.kinds()[object.kind].material});
  return objects;
}

// Reads all tiles of the scenes: the view that has them, and the number of their triangles.
std::pair<model::scene::SceneViewPointer, std::size_t> read_all(radar::Theatre& theatre,
                                                                const std::vector<model::scene::IndexedScene>& index,
                                                                const radar::Warn& warn) {
  model::scene::SceneViewPointer view;
  for (const model::scene::IndexedScene& scene : index)
    view = theatre.scenes_near(scene.placement.position, scene.reach_m, warn);
  if (!view) radar::fail(error::usage_error("scene", "a scene file", "none"));
  std::set<const model::scene::Tile*> counted;
  std::vector<const model::scene::Tile*> tiles;
  std::size_t triangles = 0;
  for (const model::scene::IndexedScene& scene : index) {
    view->tiles_near(scene.placement.position, scene.reach_m, tiles);
    for (const model::scene::Tile* tile : tiles)
      if (counted.insert(tile).second) triangles += tile->triangles();
  }
  return {std::move(view), triangles};
}

}  // namespace

Expected<Scene> Scene::read(const std::vector<std::string>& files, const Terrain& terrain,
                            const std::vector<std::string>& without, const Call& call) {
  return radar::guarded([&] {
    const radar::Warn warn = radar::warn_of(call);
    std::vector<radar::Scene> scenes;
    if (auto added = model::scene::add_scenes(scenes, files, without); !added) {
      Error& problem = added.error();
      if (problem.subject == "scene_without") problem.subject = "without";
      radar::fail(error::usage_error(problem));
    }
    std::vector<std::string> problems;
    const auto index = model::scene::index_scenes(scenes, problems);
    if (!index) radar::fail(index.error());
    for (const std::string& problem : problems) warn(problem);
    const auto [view, triangles] =
        terrain.stores()->with_theatre(scenes, model::scene::SceneUse::triangles, call.goes_on,
                                       [&](radar::Theatre& theatre) { return read_all(theatre, *index, warn); });
    std::vector<SceneObject> objects = objects_of(*view);
    std::vector<radar::FootprintGroup> groups = groups_of(objects);
    return Scene(std::make_shared<const Parts>(
        Parts{terrain, std::move(scenes), std::move(objects), std::move(groups), triangles}));
  });
}

const Terrain& Scene::terrain() const {
  return parts_->terrain;
}
const std::vector<SceneObject>& Scene::objects() const {
  return parts_->objects;
}
std::size_t Scene::triangles() const {
  return parts_->triangles;
}

namespace radar {

std::int32_t object_at(const std::vector<FootprintGroup>& groups, geo::GeoPoint position) {
  std::int32_t found = -1;
  for (const FootprintGroup& group : groups) {
    const double north_deg = std::abs(position.latitude_deg - group.origin.latitude_deg);
    if (north_deg * geo::kMetresPerDegree > 1.1 * group.reach_m) continue;
    const geo::PlanePoint at = geo::AzimuthalEquidistant(group.origin).plane_from_geodetic(position);
    if (std::hypot(at.x_m, at.y_m) > group.reach_m) continue;
    for (const Footprint& footprint : group.footprints) {
      const double east_m = at.x_m - footprint.east_m, north_m = at.y_m - footprint.north_m;
      if (std::abs(east_m * footprint.sine + north_m * footprint.cosine) <= footprint.half_length_m &&
          std::abs(east_m * footprint.cosine - north_m * footprint.sine) <= footprint.half_width_m)
        found = footprint.object;
    }
  }
  return found;
}

void check_same_terrain(const yars::Scene* scene, const Terrain& terrain) {
  if (scene == nullptr || scene->terrain().folder() == terrain.folder()) return;
  std::error_code none;  // of a folder that is gone
  if (!terrain.folder().empty() && std::filesystem::equivalent(scene->terrain().folder(), terrain.folder(), none))
    return;
  const auto name_of = [](const Terrain& one) {
    return one.folder().empty() ? "the built-in hills" : '\'' + one.folder() + '\'';
  };
  fail(error::usage_error("scene", "a scene on the terrain of this call, " + name_of(terrain),
                          "one on " + name_of(scene->terrain()), "make a Scene with this terrain"));
}

}  // namespace radar

}  // namespace yars
