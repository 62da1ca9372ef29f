#include "model/scene/placed_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/scene/plane.hpp"

namespace yars::model::scene {

namespace {

constexpr double kSceneCell_deg = 0.25;  // scenes are some kilometres across

using Hits = std::vector<GridIndex::Hit>;

// Reused by every query of a thread: a patch asks hundreds of times a second.
Hits& scratch(int which) {
  thread_local std::array<Hits, 2> hits;
  hits[static_cast<std::size_t>(which)].clear();
  return hits[static_cast<std::size_t>(which)];
}

double beyond(double value, double least, double most) {
  return std::max({0.0, least - value, value - most});
}

bool is_within(const Tile& tile, double reach_m, geo::GeoPoint place, double distance_m, double radius_m) {
  if (distance_m + reach_m <= radius_m) return true;
  const PlanePoint at = Plane(tile.origin).point_of(place);
  const Bounds& b = tile.bounds;
  return std::hypot(beyond(at.east_m, static_cast<double>(b.east_least_m), static_cast<double>(b.east_most_m)),
                    beyond(at.north_m, static_cast<double>(b.north_least_m), static_cast<double>(b.north_most_m))) <=
         radius_m;
}

}  // namespace

PlacedView::PlacedView(std::uint64_t generation, std::vector<Part> parts, std::vector<SurfaceKind> kinds,
                       std::vector<SceneObject> objects)
    : generation_(generation), parts_(std::move(parts)), kinds_(std::move(kinds)), objects_(std::move(objects)) {
  std::vector<Disc> discs;
  for (const Part& part : parts_) {
    // Bounds of tiles are boxes; their corners reach somewhat farther than what is in them.
    discs.push_back({part.scene->placement.place, 1.5 * part.scene->reach_m + kTileSide_m});
    bytes_ += part.scene->bytes;
    if (part.scene->scatterers) scatterers_.push_back(part.scene->scatterers.get());
  }
  places_ = GridIndex(discs, kSceneCell_deg);
  bytes_ += places_.bytes() + objects_.capacity() * sizeof(SceneObject) + kinds_.capacity() * sizeof(SurfaceKind);
}

void PlacedView::tiles_near(geo::GeoPoint place, double radius_m, std::vector<const Tile*>& found) const {
  found.clear();
  Hits& scenes = scratch(0);
  places_.find(place, radius_m, scenes);
  std::sort(scenes.begin(), scenes.end());
  for (const GridIndex::Hit& scene : scenes) {
    const PlacedScene& placed = *parts_[scene.disc].scene;
    Hits& tiles = scratch(1);
    placed.tile_index.find(place, radius_m, tiles);
    std::sort(tiles.begin(), tiles.end());
    for (const GridIndex::Hit& tile : tiles)
      if (is_within(placed.tiles[tile.disc], placed.tile_reach_m[tile.disc], place, tile.distance_m, radius_m))
        found.push_back(&placed.tiles[tile.disc]);
  }
}

void PlacedView::objects_near(geo::GeoPoint place, double radius_m, std::vector<std::uint32_t>& found) const {
  found.clear();
  Hits& scenes = scratch(0);
  places_.find(place, radius_m, scenes);
  for (const GridIndex::Hit& scene : scenes) {
    Hits& objects = scratch(1);
    parts_[scene.disc].scene->object_index.find(place, radius_m, objects);
    for (const GridIndex::Hit& object : objects) found.push_back(parts_[scene.disc].first_object + object.disc);
  }
  std::sort(found.begin(), found.end());
}

}  // namespace yars::model::scene
