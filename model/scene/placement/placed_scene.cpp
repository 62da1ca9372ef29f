#include "model/scene/placement/placed_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "lib/geo/frames.hpp"
#include "model/scene/placement/geometry.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/scene/placement/tile_builder.hpp"

namespace yars::model::scene {

namespace {

// Approximate maximum number of pieces into which draped triangles are cut. A scene that needs more gets larger pieces.
constexpr double kMaxDraped = 100'000;
constexpr double kTileCell_deg = 1.0 / 64.0;  // [deg] side of a square of the index that finds tiles by position
// Approximate maximum number of pieces into which large faces are cut for scatterers. A scene that needs more gets
// larger pieces.
constexpr double kMaxPieces = 1'000'000;

// Extent of one object of the model: bounding rectangle seen from above, range of heights, area by surface kind.
struct Outline {
  Footprint box;
  double min_z_m = 0.0, max_z_m = 0.0;
  std::map<std::uint16_t, double> area_by_kind;
  bool empty = true;
  bool flat() const { return min_z_m >= -kFlat_m && max_z_m <= kFlat_m; }
};

class ScenePlacer {
 public:
  ScenePlacer(const Model& model, const Placement& placement, const terrain::TerrainView& ground,
              std::uint32_t first_object, const KindTable& kinds, SceneUse use, double max_reach_m)
      : model_(model),
        placement_(placement),
        ground_(ground),
        plane_(placement.position),
        first_object_(first_object),
        kinds_(kinds),
        use_(use),
        builders_(plane_, use == SceneUse::triangles ? model.vertices.size() : 0),
        scatter_(max_reach_m) {
    const double heading_rad = placement.heading_deg * geo::kRadiansPerDegree;
    sine_ = std::sin(heading_rad);
    cosine_ = std::cos(heading_rad);
    for (const SurfaceKind& kind : model.kinds) kind_numbers_.push_back(kinds.known_number_of(kind));
  }

  PlacedScene run() {
    anchor_msl_m_ = placement_.heights == radar::SceneHeights::sea_level ? 0.0 : height_at(placement_.position, 0.0);
    sort_by_object();
    for (std::uint32_t object = 0; object < model_.objects.size(); ++object) outlines_.push_back(outline_of(object));
    edge_m_ =
        bounded_edge(kDrapedEdge_m, kMaxDraped, [&](const ModelTriangle& triangle) { return is_draped(triangle); });
    if (use_ == SceneUse::scatterers)
      piece_edge_m_ = bounded_edge(piece_edge_m_, kMaxPieces, [](const ModelTriangle&) { return true; });
    PlacedScene placed;
    placed.placement = placement_;
    for (std::uint32_t object = 0; object < model_.objects.size(); ++object) place_object(object, placed);
    placed.tiles = builders_.take(anchor_msl_m_);
    placed.scatterers = scatter_.take(plane_);
    finish(placed);
    return placed;
  }

 private:
  bool follows_ground() const { return placement_.heights == radar::SceneHeights::ground; }

  double height_at(geo::GeoPoint position, double otherwise_m) const {
    const double height_m = ground_.surface_at(position).elevation_m;
    return std::isfinite(height_m) ? height_m : otherwise_m;
  }

  Vector3 model_position(std::uint32_t vertex) const {
    return vector_of(model_.vertices[vertex].position_m) + model_.base;
  }
  Vector3 rotated(Vector3 v) const { return {v.x * cosine_ + v.y * sine_, v.y * cosine_ - v.x * sine_, v.z}; }

  // Sorts the triangles by object, and by triangle number within an object.
  void sort_by_object() {
    begin_.assign(model_.objects.size() + 1, 0);
    for (const ModelTriangle& triangle : model_.triangles) ++begin_[triangle.object + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    order_.resize(model_.triangles.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) order_[next[model_.triangles[i].object]++] = i;
  }

  bool is_flat(const ModelTriangle& triangle) const {
    return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                       [&](std::uint32_t corner) { return std::abs(model_position(corner).z) <= kFlat_m; });
  }

  bool is_draped(const ModelTriangle& triangle) const {
    return follows_ground() && (triangle.object == 0 ? is_flat(triangle) : outlines_[triangle.object].flat());
  }

  Outline outline_of(std::uint32_t object) {
    Outline outline;
    points_.clear();
    for (std::uint32_t i = begin_[object]; i < begin_[object + 1]; ++i) {
      const ModelTriangle& triangle = model_.triangles[order_[i]];
      std::array<Vector3, 3> at;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        at[corner] = rotated(model_position(triangle.corners[corner]));
        add_point({at[corner].x, at[corner].y});
        outline.min_z_m = outline.empty ? at[corner].z : std::min(outline.min_z_m, at[corner].z);
        outline.max_z_m = outline.empty ? at[corner].z : std::max(outline.max_z_m, at[corner].z);
        outline.empty = false;
      }
      const double area_m2 = 0.5 * length(cross(at[1] - at[0], at[2] - at[0]));
      outline.area_by_kind[triangle.kind] += area_m2;
    }
    outline.box = footprint_of(points_);
    return outline;
  }

  // Leaves out a point equal to one of the three before: the corners of the other triangle of a face, and the lower
  // corners of a wall.
  void add_point(geo::PlanePoint point) {
    const auto recent = points_.end() - static_cast<std::ptrdiff_t>(std::min<std::size_t>(points_.size(), 3));
    const auto same = [&](geo::PlanePoint other) { return other.x_m == point.x_m && other.y_m == point.y_m; };
    if (std::none_of(recent, points_.end(), same)) points_.push_back(point);
  }

  void place_object(std::uint32_t number, PlacedScene& placed) {
    const Outline& outline = outlines_[number];
    SceneObject& object = placed.objects.emplace_back();
    object.name = model_.objects[number];
    object.middle = plane_.geodetic_from_plane({outline.box.middle.x_m, outline.box.middle.y_m});
    object.base_msl_m = anchor_msl_m_;
    if (follows_ground() && number != 0) object.base_msl_m = height_at(object.middle, anchor_msl_m_);
    object.height_m = outline.empty ? 0.0 : std::max(0.0, outline.max_z_m);
    object.length_m = outline.box.length_m;
    object.width_m = outline.box.width_m;
    // The rectangle's direction is counter-clockwise from the plane's x axis; the heading is clockwise from true north
    // at the object. The convergence of the meridians is the angle from true north clockwise to the plane's y axis.
    const double convergence_deg =
        geo::wrapped_degrees(object.middle.longitude_deg - placement_.position.longitude_deg) *
        std::sin((object.middle.latitude_deg + placement_.position.latitude_deg) / 2 * geo::kRadiansPerDegree);
    const double heading_deg = 90.0 - outline.box.direction_rad * 180.0 / std::numbers::pi + convergence_deg;
    object.heading_deg = std::fmod(heading_deg + 720.0, 180.0);
    double max_m2 = -1.0;
    for (const auto& [kind, area_m2] : outline.area_by_kind)
      if (area_m2 > max_m2) {
        max_m2 = area_m2;
        object.kind = kind_numbers_[kind];
      }
    for (std::uint32_t i = begin_[number]; i < begin_[number + 1]; ++i) {
      const ModelTriangle& triangle = model_.triangles[order_[i]];
      if (is_draped(triangle))
        drape(triangle, number);
      else
        place_standing(triangle, number, object.base_msl_m);
    }
  }

  SurfaceTag tag_of(const ModelTriangle& triangle, std::uint32_t object, bool on_ground) const {
    return {kind_numbers_[triangle.kind], first_object_ + object, on_ground};
  }

  // True for a level upward face on the ground: less than kOnGround_m above `base_m`, the altitude of the object's
  // base. With SceneHeights::sea_level: less than kNearGround_m above or below the terrain. This limit is larger,
  // because terrain is less exact than the scene.
  bool lies_on_ground(const Corners3& corners, double base_m) const {
    const Vector3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(area.z > kLevelNormal * length(area))) return false;
    if (placement_.heights != radar::SceneHeights::sea_level) return corners[0].z - base_m < kOnGround_m;
    return std::all_of(corners.begin(), corners.end(), [&](Vector3 corner) {
      const double ground_m = height_at(plane_.geodetic_from_plane({corner.x, corner.y}), base_m);
      return std::abs(corner.z - ground_m) < kNearGround_m;
    });
  }

  void place_standing(const ModelTriangle& triangle, std::uint32_t object, double base_m) {
    Corners3 corners_m = rotated_corners(triangle);
    for (Vector3& position : corners_m) {
      position.z += base_m;
      extend_reach(position);
    }
    const bool on_ground = lies_on_ground(corners_m, base_m);
    if (use_ == SceneUse::scatterers) return scatter(corners_m, model_.kinds[triangle.kind].material, on_ground);
    std::array<PlacedCorner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = {corners_m[i], rotated(vector_of(model_.vertices[triangle.corners[i]].normal)), triangle.corners[i]};
    builders_.add(corners, tag_of(triangle, object, on_ground));
  }

  Corners3 rotated_corners(const ModelTriangle& triangle) const {
    Corners3 corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = rotated(model_position(triangle.corners[i]));
    return corners;
  }

  void drape(const ModelTriangle& triangle, std::uint32_t object) {
    cutter_.cut(rotated_corners(triangle), edge_m_,
                [&](const Corners3& piece) { add_draped(piece, tag_of(triangle, object, true)); });
  }

  // Cuts a face into pieces and adds these to the scatterers. Used for faces that are not draped.
  void scatter(const Corners3& corners, std::uint8_t material, bool on_ground) {
    cutter_.cut(corners, piece_edge_m_, [&](const Corners3& piece) {
      on_ground ? scatter_.add_lying(piece, material) : scatter_.add_standing(piece, material);
    });
  }

  // Returns `edge_m`, the limit of a piece's edges, doubled until there are about `max_pieces` pieces or fewer. Only
  // triangles for which `counts` is true are counted. Estimated number of pieces of a triangle of length L and width W,
  // at the limit e: (L / e) * (1 + W / e).
  template <class Counts>
  double bounded_edge(double edge_m, double max_pieces, const Counts& counts) const {
    const auto pieces = [&] {
      double sum = 0.0;
      for (const ModelTriangle& triangle : model_.triangles) {
        const Corners3 corners = rotated_corners(triangle);
        if (has_no_longer_edge(corners, edge_m)) continue;
        const double longest_m = longest_plan_edge(corners).length_m;
        if (!(longest_m > edge_m) || !counts(triangle)) continue;
        const double width_m = length(cross(corners[1] - corners[0], corners[2] - corners[0])) / longest_m;
        sum += longest_m / edge_m * (1.0 + width_m / edge_m);
      }
      return sum;
    };
    // The negated comparison treats NaN as too many pieces. At an infinite edge nothing is cut, so the loop ends.
    while (!(pieces() <= max_pieces)) edge_m *= 2.0;
    return edge_m;
  }

  void add_draped(Corners3 piece, SurfaceTag tag) {
    for (Vector3& corner : piece) {
      const LocalMap& map = builders_.map_at({corner.x, corner.y});
      corner.z += height_at(map.position_of({corner.x, corner.y}), anchor_msl_m_);
      extend_reach(corner);
    }
    const Vector3 area = cross(piece[1] - piece[0], piece[2] - piece[0]);
    const double size = length(area);
    if (!(size > 0.0)) return;
    if (use_ == SceneUse::scatterers) return scatter_.add_lying(piece, kinds_.kinds()[tag.kind].material);
    const Vector3 normal = (1.0 / size) * area;
    builders_.add({PlacedCorner{piece[0], normal, kNone}, PlacedCorner{piece[1], normal, kNone},
                   PlacedCorner{piece[2], normal, kNone}},
                  tag);
  }

  void extend_reach(Vector3 at) { reach_m2_ = std::max(reach_m2_, at.x * at.x + at.y * at.y); }

  void finish(PlacedScene& placed) const {
    placed.reach_m = std::sqrt(reach_m2_);
    std::vector<Disc> discs;
    for (const Tile& tile : placed.tiles) {
      const Bounds& b = tile.bounds;
      const double east_m = std::max(std::abs(b.east_min_m), std::abs(b.east_max_m));
      const double north_m = std::max(std::abs(b.north_min_m), std::abs(b.north_max_m));
      placed.tile_reach_m.push_back(std::hypot(east_m, north_m));
      discs.push_back({tile.origin, placed.tile_reach_m.back()});
      placed.bytes += bytes_of(tile);
    }
    placed.tile_index = GridIndex(discs, kTileCell_deg);
    for (const SceneObject& object : placed.objects) placed.bytes += sizeof(SceneObject) + object.name.capacity();
    placed.bytes += placed.tile_index.bytes();
    if (placed.scatterers) placed.bytes += placed.scatterers->bytes();
  }

  const Model& model_;
  Placement placement_;
  const terrain::TerrainView& ground_;
  geo::AzimuthalEquidistant plane_;
  std::uint32_t first_object_;
  const KindTable& kinds_;
  SceneUse use_;
  TileBuilders builders_;
  ScatterBuilder scatter_;
  double sine_ = 0.0, cosine_ = 1.0;
  double anchor_msl_m_ = 0.0;  // altitude of the terrain at the scene's position; 0: void, or SceneHeights::sea_level
  // [m] Limits of the edges of pieces. edge_m_: pieces of draped triangles. piece_edge_m_: pieces of other faces.
  double edge_m_ = kDrapedEdge_m;
  double piece_edge_m_ = kScattererSides_m.front();
  double reach_m2_ = 0.0;                    // [m^2] square of PlacedScene::reach_m
  std::vector<std::uint16_t> kind_numbers_;  // for each entry of Model::kinds: its number in kinds_
  // order_: triangle numbers, sorted by object. begin_[o] and begin_[o + 1] bound the entries of object o.
  std::vector<std::uint32_t> begin_, order_;
  std::vector<Outline> outlines_;
  std::vector<geo::PlanePoint> points_;
  TriangleCutter cutter_;
};

}  // namespace

PlacedScene place_model(const Model& model, const Placement& placement, const terrain::TerrainView& ground,
                        std::uint32_t first_object, KindTable& kinds, SceneUse use, double max_reach_m) {
  for (const SurfaceKind& kind : model.kinds) kinds.number_of(kind);
  return place_known_model(model, placement, ground, first_object, kinds, use, max_reach_m);
}

PlacedScene place_known_model(const Model& model, const Placement& placement, const terrain::TerrainView& ground,
                              std::uint32_t first_object, const KindTable& kinds, SceneUse use, double max_reach_m) {
  return ScenePlacer(model, placement, ground, first_object, kinds, use, max_reach_m).run();
}

}  // namespace yars::model::scene
