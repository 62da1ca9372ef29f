// Puts a model on the earth: x and y are metres on the azimuthal-equidistant plane about its place, turned by the
// heading; tiles are 128 m squares of that plane, each flattened about its own origin (below 1 mm off within 20 km).
// `ground`: an object whose corners all lie within 1 m of z = 0 (a runway, a road) is draped: cut to edges of 30 m
// (more where it is very large), every corner on the terrain below it plus its z. Any other object stands level on the
// terrain under the middle of its box. Faces outside objects: flat triangles are draped, others stand on the terrain at
// the scene's place. Void terrain counts as the height at the place, there as 0. A model's object n is
// PlacedScene::objects[n]; the kinds are entered into `kinds`.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "lib/radar/world.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/placement/scatterers.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/scene/placement/spatial_index.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::scene {

inline constexpr double kFlat_m = 1.0;         // how far from z = 0 a thing that is draped may reach
inline constexpr double kDrapedEdge_m = 30.0;  // below the post spacing of DTED level 2

struct Placement {
  geo::GeoPoint position;
  double heading_deg = 0.0;
  radar::SceneHeights heights = radar::SceneHeights::ground;
};

// What is kept of a scene: triangles for who resolves them, scatterers for who does not.
enum class SceneUse : std::uint8_t { triangles, scatterers };

struct PlacedScene {
  Placement placement;
  double reach_m = 0.0;  // from the place to the farthest corner
  std::vector<Tile> tiles;
  std::vector<SceneObject> objects;
  GridIndex tile_index, object_index;
  std::vector<double> tile_reach_m;              // from a tile's origin to the farthest corner of its bounds
  std::shared_ptr<const Scatterers> scatterers;  // null where there are none
  std::uint64_t bytes = 0;
};

// `first_object`: what Tile::object counts from. Scatterers beyond `most_reach_m` of the place are left out.
PlacedScene place_model(const Model& model, const Placement& placement, const terrain::TerrainView& ground,
                        std::uint32_t first_object, KindTable& kinds, SceneUse use = SceneUse::triangles,
                        double max_reach_m = std::numeric_limits<double>::infinity());

}  // namespace yars::model::scene
