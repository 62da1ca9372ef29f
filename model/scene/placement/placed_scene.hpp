// Placement of a model on the earth: tiles, objects and scatterers of one scene.
// Inputs: a Model, its position and heading, terrain. Outputs: a PlacedScene. Units: metres, degrees.
// Frame: x east, y north on the azimuthal equidistant plane about the position, after rotation by the heading. Tiles
// are 128 m squares of that plane. The transform from the plane to a tile is linear. Its error is below 1 mm up to
// 20 km from the position. Heights: see Placement.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "lib/radar/modes.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/placement/geometry.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::scene {

inline constexpr double kFlat_m = 1.0;  // maximum |z| of draped objects and faces
// Limit of the edges of draped pieces; about the spacing of DTED level 2 posts along a meridian.
inline constexpr double kDrapedEdge_m = 30.0;

// Position, heading and heights of a scene. Heights, by SceneHeights (z: the model's z axis, upwards):
// ground: an object with all vertices within 1 m of z = 0 is draped. Its triangles are cut into pieces with edges of at
// most 30 m, seen from above. In a scene with more than about 100,000 such pieces, this limit is doubled, repeatedly.
// Each corner of a piece is placed at its height z above the terrain. Any other object has z = 0 at the altitude of the
// terrain at the centre of the object's bounding rectangle. Faces outside objects are draped if they are within 1 m of
// z = 0. Other faces outside objects have z = 0 at the altitude of the terrain at the scene's position.
// anchor: the whole scene has z = 0 at the altitude of the terrain at the scene's position.
// sea_level: z = 0 is mean sea level.
// Where the terrain is void, the terrain's altitude at the scene's position is used, or 0 if the terrain is void there,
// too.
struct Placement {
  geo::GeoPoint position;
  double heading_deg = 0.0;  // [deg] true heading of the model's y axis
  radar::SceneHeights heights = radar::SceneHeights::ground;
};

// Contents of a placed scene: triangles for patch maps, or scatterers for radar modes that do not resolve the scene.
enum class SceneUse : std::uint8_t { triangles, scatterers };

struct PlacedScene {
  Placement placement;
  double reach_m = 0.0;  // horizontal distance from the position to the farthest corner of a triangle
  std::vector<Tile> tiles;
  std::vector<SceneObject> objects;
  GridIndex tile_index;
  std::vector<double> tile_reach_m;              // distance from a tile's origin to the farthest corner of its bounds
  std::shared_ptr<const Scatterers> scatterers;  // null: none
  std::uint64_t bytes = 0;
};

// Places a model on the terrain `ground`. Object n of the model becomes PlacedScene::objects[n]. `first_object` is
// added to Tile::object. Surface kinds of the model are added to `kinds`. Faces farther than `max_reach_m` from the
// scene's position are left out of the scatterers.
PlacedScene place_model(const Model& model, const Placement& placement, const terrain::TerrainView& ground,
                        std::uint32_t first_object, KindTable& kinds, SceneUse use = SceneUse::triangles,
                        double max_reach_m = std::numeric_limits<double>::infinity());

// The same for a model whose surface kinds are in `kinds`: several models may be placed at once.
PlacedScene place_known_model(const Model& model, const Placement& placement, const terrain::TerrainView& ground,
                              std::uint32_t first_object, const KindTable& kinds, SceneUse use, double max_reach_m);

}  // namespace yars::model::scene
