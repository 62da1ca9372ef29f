#include "model/hrm/scene_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace yars::model::hrm {

namespace {
constexpr float kSmooth = 0.02F;  // vertices that face the radar so differently from the facet are interpolated
constexpr float kReach = 0.5F;    // [rows] of a surface beyond its edges

// Half-open: a grid point on an edge between two triangles belongs to exactly one.
int first_at(float value) {
  return static_cast<int>(std::ceil(value));
}
}  // namespace

// The normal of a triangle: right, ahead, up, in metres; and its extent on the grid.
struct SceneRaster::Facet {
  Facet(const Canvas& canvas, const Triangle& corner)
      : c1(corner[1].column - corner[0].column),
        c2(corner[2].column - corner[0].column),
        r1(corner[1].row - corner[0].row),
        r2(corner[2].row - corner[0].row),
        z1(corner[1].height_m - corner[0].height_m),
        z2(corner[2].height_m - corner[0].height_m),
        across(canvas.row_height_m * (r1 * z2 - z1 * r2)),
        ahead(canvas.column_width_m * (z1 * c2 - c1 * z2)),
        area(c1 * r2 - r1 * c2),
        upward(canvas.column_width_m * canvas.row_height_m * area),
        level2(across * across + ahead * ahead) {}
  Plane plane(const Vertex& corner) const {
    const float inverse = 1.0F / area;
    const float by_column = (z1 * r2 - z2 * r1) * inverse;
    const float by_row = (c1 * z2 - c2 * z1) * inverse;
    return {corner.height_m - by_column * corner.column - by_row * corner.row, by_column, by_row};
  }

  float c1, c2, r1, r2, z1, z2;  // edges from the first corner
  float across, ahead;
  float area;  // grid cells
  float upward;
  float level2;  // square of the level part
};

SceneRaster::SceneRaster(const radar::RadarConfiguration& configuration) : surface_(configuration) {}

SceneRaster::Placement SceneRaster::place(const PatchGeometry& geometry, const scene::Tile& tile) const {
  const geo::GeodesicInverse way = geo::geodesic_inverse(geometry.apex(), tile.origin);
  const double turn_rad = (way.azimuth_at_start - geometry.up()).radians();
  const double away_rad = way.azimuth_at_end.radians();
  const double distance_m = way.distance.metres();
  // Across the line of sight the plane is stretched against the earth.
  constexpr double kEarthRadius_m = 6371008.8;
  const double angle_rad = distance_m / kEarthRadius_m;
  const double stretch = angle_rad > 1e-6 ? angle_rad / std::sin(angle_rad) : 1.0;
  const double sine = std::sin(turn_rad);
  const double cosine = std::cos(turn_rad);
  // East and north as parts along and across the line of sight, then turned onto the map.
  const double along_east = std::sin(away_rad);
  const double along_north = std::cos(away_rad);
  const double across_east = stretch * std::cos(away_rad);
  const double across_north = -stretch * std::sin(away_rad);
  Placement placement{};
  placement.right_m = distance_m * sine;
  placement.up_m = distance_m * cosine - geometry.distance_m();
  placement.right_east = along_east * sine + across_east * cosine;
  placement.right_north = along_north * sine + across_north * cosine;
  placement.up_east = along_east * cosine - across_east * sine;
  placement.up_north = along_north * cosine - across_north * sine;
  placement.lift_m = static_cast<float>(tile.zero_msl_m - geometry.plane_msl_m());
  const rbm::Sight sight = geometry.earth().sight(geometry.altitude_m() - geometry.plane_msl_m(), distance_m, 0.0);
  placement.toward_east = static_cast<float>(-along_east * sight.cos_grazing);
  placement.toward_north = static_cast<float>(-along_north * sight.cos_grazing);
  placement.toward_up = static_cast<float>(sight.sin_grazing);
  return placement;
}

SceneRaster::Vertex SceneRaster::on_grid(const PatchGeometry& geometry, const FanGrid& grid, const Placement& placement,
                                         float east_m, float north_m, float height_m) const {
  const double right_m = placement.right_m + placement.right_east * static_cast<double>(east_m) +
                         placement.right_north * static_cast<double>(north_m);
  const double up_m = placement.up_m + placement.up_east * static_cast<double>(east_m) +
                      placement.up_north * static_cast<double>(north_m);
  const double ahead_m = std::max(geometry.distance_m() + up_m, 1.0);
  const double distance_m = std::sqrt(right_m * right_m + ahead_m * ahead_m);
  return {static_cast<float>((right_m / ahead_m - grid.first_tangent) / grid.tangent_step),
          static_cast<float>((distance_m - grid.first_distance_m) / grid.spacing_m), height_m, 0.0F};
}

bool SceneRaster::overlaps(const PatchGeometry& geometry, const FanGrid& grid, const Placement& placement,
                           const scene::Tile& tile, int first, int last) const {
  float least_column = std::numeric_limits<float>::max();
  float most_column = std::numeric_limits<float>::lowest();
  float least_row = least_column;
  float most_row = most_column;
  for (const float east_m : {tile.bounds.east_least_m, tile.bounds.east_most_m}) {
    for (const float north_m : {tile.bounds.north_least_m, tile.bounds.north_most_m}) {
      const Vertex corner = on_grid(geometry, grid, placement, east_m, north_m, 0.0F);
      least_column = std::min(least_column, corner.column);
      most_column = std::max(most_column, corner.column);
      least_row = std::min(least_row, corner.row);
      most_row = std::max(most_row, corner.row);
    }
  }
  // A row more: distance curves a little within a large tile.
  return most_column >= static_cast<float>(first) && least_column < static_cast<float>(last) && most_row >= -1.0F &&
         least_row < static_cast<float>(grid.rows) + 1.0F;
}

void SceneRaster::transform(const PatchGeometry& geometry, const FanGrid& grid, const Placement& placement,
                            const scene::Tile& tile) {
  const std::size_t count = tile.east_m.size();
  for (std::vector<float>* numbers : {&column_, &row_, &height_m_, &facing_})
    if (numbers->size() < count) numbers->resize(count);
  lanes::VertexMap map{};
  map.right_m = static_cast<float>(placement.right_m);
  map.up_m = static_cast<float>(placement.up_m);
  map.right_east = static_cast<float>(placement.right_east);
  map.right_north = static_cast<float>(placement.right_north);
  map.up_east = static_cast<float>(placement.up_east);
  map.up_north = static_cast<float>(placement.up_north);
  map.lift_m = placement.lift_m;
  map.toward_east = placement.toward_east;
  map.toward_north = placement.toward_north;
  map.toward_up = placement.toward_up;
  map.centre_m = static_cast<float>(geometry.distance_m());
  map.columns_a_tangent = static_cast<float>(1.0 / grid.tangent_step);
  map.middle_column = static_cast<float>(-grid.first_tangent / grid.tangent_step);
  map.rows_a_metre = static_cast<float>(1.0 / grid.spacing_m);
  map.middle_row = static_cast<float>((geometry.distance_m() - grid.first_distance_m) / grid.spacing_m);
  lanes::place_vertices(count,
                        {tile.east_m.data(), tile.north_m.data(), tile.up_m.data(), tile.normal_east.data(),
                         tile.normal_north.data(), tile.normal_up.data()},
                        map, vertices());
}

void SceneRaster::draw(const PatchGeometry& geometry, const FanGrid& grid, const scene::SceneView& scene,
                       const std::vector<const scene::Tile*>& tiles, int first, int last, const SceneArrays& arrays) {
  for (const scene::Tile* tile : tiles) {
    const Placement placement = place(geometry, *tile);
    if (!overlaps(geometry, grid, placement, *tile, first, last)) continue;
    const double distance_m = std::hypot(placement.right_m, placement.up_m + geometry.distance_m());
    const double column = placement.right_m / std::max(placement.up_m + geometry.distance_m(), 1.0);
    const Canvas canvas{&grid,
                        arrays,
                        first,
                        last,
                        static_cast<float>(distance_m * grid.tangent_step / (1.0 + column * column)),
                        static_cast<float>(grid.spacing_m),
                        placement.toward_up,
                        std::sqrt(1.0F - placement.toward_up * placement.toward_up)};
    transform(geometry, grid, placement, *tile);
    draw_tile(scene, *tile, placement, canvas);
  }
}

void SceneRaster::draw_tile(const scene::SceneView& scene, const scene::Tile& tile, const Placement& placement,
                            const Canvas& canvas) {
  constexpr std::size_t kSlack = 16;  // entries that vectors may touch behind the last
  if (found_.size() < tile.corners.size() + kSlack) found_.resize(tile.corners.size() + kSlack);
  const lanes::GridLimits limits{static_cast<float>(canvas.first),
                                 static_cast<float>(canvas.last),
                                 -kReach,
                                 static_cast<float>(canvas.grid->rows),
                                 canvas.column_width_m,
                                 canvas.row_height_m,
                                 canvas.sine,
                                 canvas.cosine,
                                 static_cast<float>(kWallNormal2)};
  const std::size_t count =
      lanes::select_triangles(tile.corners.size(), tile.corners.data(), vertices(), limits, found_.data());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t t = found_[i];
    const Triangle corner{vertex(tile.corners[t][0]), vertex(tile.corners[t][1]), vertex(tile.corners[t][2])};
    const Surface surface{
        scene.kinds()[tile.kind[t]].material,
        static_cast<float>(scene.objects()[tile.object[t]].base_msl_m - tile.zero_msl_m) + placement.lift_m};
    draw_triangle(canvas, corner, surface);
  }
}

void SceneRaster::draw_triangle(const Canvas& canvas, const Triangle& corner, const Surface& surface) const {
  const Facet facet(canvas, corner);
  const float towards = -facet.ahead * canvas.cosine + facet.upward * canvas.sine;
  const bool steep = facet.upward * facet.upward < static_cast<float>(kWallNormal2) * facet.level2;
  if (steep && towards > 0.0F)
    mark_wall(canvas, corner,
              static_cast<float>(surface_.wall_gamma(surface.code, static_cast<double>(facet.across),
                                                     static_cast<double>(-facet.ahead))));
  if (!(facet.area > 0.0F)) return;  // seen from below, or on edge
  const float length = std::sqrt(facet.level2 + facet.upward * facet.upward);
  const bool flat = facet.upward > static_cast<float>(kLevelNormal) * length &&
                    corner[0].height_m - surface.base_m < static_cast<float>(kOnGround_m);
  const auto gamma = static_cast<float>(surface_.gamma(surface.code));
  fill(canvas, corner, facet.plane(corner[0]), gamma * shading(corner, towards / length), flat);
}

// How much more or less squarely the interpolated normals face the radar than the facet does.
float SceneRaster::shading(const Triangle& corner, float facing) {
  if (!(facing > 0.0F)) return 1.0F;
  bool smooth = false;
  for (const Vertex& vertex : corner) smooth = smooth || std::abs(vertex.facing - facing) > kSmooth;
  if (!smooth) return 1.0F;
  const float mean = (corner[0].facing + corner[1].facing + corner[2].facing) / 3.0F;
  return std::clamp(mean / facing, 0.0F, static_cast<float>(kMostShading));
}

// Column by column, for a column is a profile: a surface reaches half a row beyond its edges, so that on average it
// is as long as it is, and its height there is that of the edge.
void SceneRaster::fill(const Canvas& canvas, const Triangle& corner, const Plane& plane, float gain, bool flat) {
  Triangle across = corner;
  if (across[1].column < across[0].column) std::swap(across[0], across[1]);
  if (across[2].column < across[1].column) std::swap(across[1], across[2]);
  if (across[1].column < across[0].column) std::swap(across[0], across[1]);
  const Vertex& left = across[0];
  const Vertex& middle = across[1];
  const Vertex& right = across[2];
  const float reach = flat ? 0.0F : kReach;
  const int end = std::min(first_at(right.column), canvas.last);
  for (int column = std::max(first_at(left.column), canvas.first); column < end; ++column) {
    const auto x = static_cast<float>(column);
    const float along = left.row + (right.row - left.row) * (x - left.column) / (right.column - left.column);
    const float beside =
        x < middle.column
            ? left.row + (middle.row - left.row) * (x - left.column) / (middle.column - left.column)
            : middle.row + (right.row - middle.row) * (x - middle.column) / (right.column - middle.column);
    const float near = std::min(along, beside);
    const float far = std::max(along, beside);
    const int last = std::min(first_at(far + reach), canvas.grid->rows);
    int row = std::max(first_at(near - reach), 0);
    for (std::size_t at = canvas.grid->at(column, row); row < last; ++row, at += kStripColumns) {
      if (flat) {
        if (canvas.arrays.gain[at] >= 0.0F) canvas.arrays.gain[at] = gain;
        continue;
      }
      const float height = plane.at(x, std::clamp(static_cast<float>(row), near, far));
      if (height <= canvas.arrays.height_m[at]) continue;
      canvas.arrays.height_m[at] = height;
      canvas.arrays.gain[at] = -gain;
    }
  }
}

// Seen from above the wall is the line between the two corners that lie farthest apart across; the profile steps up at
// the first grid point that a surface behind the line reaches.
void SceneRaster::mark_wall(const Canvas& canvas, const Triangle& corner, float gain) {
  const auto by_column = [](const Vertex& a, const Vertex& b) { return a.column < b.column; };
  const Vertex& left = *std::min_element(corner.begin(), corner.end(), by_column);
  const Vertex& right = *std::max_element(corner.begin(), corner.end(), by_column);
  const int begin = std::max(first_at(left.column), canvas.first);
  const int end = std::min(first_at(right.column), canvas.last);
  const float width = right.column - left.column;
  const float slope = (right.row - left.row) / width;
  // Its columns together are as wide as it is. One column alone may be one of many narrow walls side by side.
  const int columns = first_at(right.column) - first_at(left.column);
  if (columns > 1) gain *= width / static_cast<float>(columns);
  for (int column = begin; column < end; ++column) {
    const int row = first_at(left.row + slope * (static_cast<float>(column) - left.column) - kReach);
    if (row < 0 || row >= canvas.grid->rows) continue;
    float& wall = canvas.arrays.wall_gain[canvas.grid->at(column, row)];
    wall = std::max(wall, gain);
  }
}

}  // namespace yars::model::hrm
