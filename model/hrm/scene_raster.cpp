#include "model/hrm/scene_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "lib/geo/geodesy.hpp"

namespace yars::model::hrm {

namespace {

constexpr int kTilesPerTask = 16;

// Position and axes of a tile on the map plane.
PlacedTile placed_tile(const PatchGeometry& geometry, const scene::Tile& tile) {
  const geo::GeodesicInverse geodesic = geo::geodesic_inverse(geometry.apex(), tile.origin);
  const double turn_rad = (geodesic.azimuth_at_start - geometry.up()).radians();
  const double away_rad = geodesic.azimuth_at_end.radians();
  const double distance_m = geodesic.distance.metres();
  // The azimuthal equidistant plane is stretched across the line of sight, by angle / sin(angle). The angle is
  // the distance divided by the earth radius.
  const double angle_rad = distance_m / geo::kMeanEarthRadius_m;
  const double stretch = angle_rad > 1e-6 ? angle_rad / std::sin(angle_rad) : 1.0;
  const double sine = std::sin(turn_rad);
  const double cosine = std::cos(turn_rad);
  // Components of the tile's east and north axes, along and across the line of sight to the tile. The code below
  // rotates them to the axes of the map.
  const double along_east = std::sin(away_rad);
  const double along_north = std::cos(away_rad);
  const double across_east = stretch * std::cos(away_rad);
  const double across_north = -stretch * std::sin(away_rad);
  PlacedTile placement;
  placement.tile = &tile;
  placement.right_m = distance_m * sine;
  placement.up_m = distance_m * cosine - geometry.distance_m();
  placement.right_east = along_east * sine + across_east * cosine;
  placement.right_north = along_north * sine + across_north * cosine;
  placement.up_east = along_east * cosine - across_east * sine;
  placement.up_north = along_north * cosine - across_north * sine;
  placement.lift_m = static_cast<float>(tile.zero_msl_m - geometry.plane_msl_m());
  const physics::Sight sight =
      geometry.earth_above_plane().sight(geometry.altitude_m() - geometry.plane_msl_m(), distance_m, 0.0);
  placement.toward_east = static_cast<float>(-along_east * sight.cos_grazing);
  placement.toward_north = static_cast<float>(-along_north * sight.cos_grazing);
  placement.toward_up = static_cast<float>(sight.sin_grazing);
  return placement;
}

// Column and row of a point of a tile.
struct GridPoint {
  float column, row;
};
GridPoint on_grid(const PatchGeometry& geometry, const PolarGrid& grid, const PlacedTile& placement, float east_m,
                  float north_m) {
  const double right_m = placement.right_m + placement.right_east * static_cast<double>(east_m) +
                         placement.right_north * static_cast<double>(north_m);
  const double up_m = placement.up_m + placement.up_east * static_cast<double>(east_m) +
                      placement.up_north * static_cast<double>(north_m);
  const double ahead_m = std::max(geometry.distance_m() + up_m, 1.0);
  const double distance_m = std::sqrt(right_m * right_m + ahead_m * ahead_m);
  return {static_cast<float>((right_m / ahead_m - grid.first_tangent) / grid.tangent_step),
          static_cast<float>((distance_m - grid.first_distance_m) / grid.spacing_m)};
}

// Sets the range of columns of a tile. Returns false if the tile is outside the polar grid.
bool find_columns(const PatchGeometry& geometry, const PolarGrid& grid, PlacedTile& placement) {
  const scene::Bounds& bounds = placement.tile->bounds;
  placement.min_column = std::numeric_limits<float>::max();
  placement.max_column = std::numeric_limits<float>::lowest();
  float min_row = placement.min_column;
  float max_row = placement.max_column;
  for (const float east_m : {bounds.east_min_m, bounds.east_max_m}) {
    for (const float north_m : {bounds.north_min_m, bounds.north_max_m}) {
      const GridPoint corner = on_grid(geometry, grid, placement, east_m, north_m);
      placement.min_column = std::min(placement.min_column, corner.column);
      placement.max_column = std::max(placement.max_column, corner.column);
      min_row = std::min(min_row, corner.row);
      max_row = std::max(max_row, corner.row);
    }
  }
  // The row limits have a margin of one row, because the corners of a large tile do not bound its distances exactly.
  return placement.max_column >= 0.0F && placement.min_column < static_cast<float>(grid.columns) && max_row >= -1.0F &&
         min_row < static_cast<float>(grid.rows) + 1.0F;
}

// Finds tiles far from the polar grid without a geodesic, which takes most of the time of placing a tile.
class FarTiles {
 public:
  FarTiles(const PatchGeometry& geometry, const PolarGrid& grid) : centre_(geometry.position_of({})) {
    for (const int column : {0, grid.columns - 1})
      for (const int row : {0, grid.rows - 1}) {
        const double tangent = grid.tangent(column);
        const double ahead_m = grid.distance_m(row) / std::sqrt(1.0 + tangent * tangent);
        reach_m_ = std::max(reach_m_, std::hypot(tangent * ahead_m, ahead_m - geometry.distance_m()));
      }
    // The row in the middle of the far edge is the farthest from the aircraft.
    reach_m_ = std::max(reach_m_, grid.distance_m(grid.rows - 1) - geometry.distance_m());
  }
  bool has(const scene::Tile& tile) const {
    constexpr double kReserve = 1.1;  // above the error of this distance. The length of a degree of longitude is the
                                      // lesser of both latitudes, so the distance is too small rather than too large.
    const double latitude_deg = std::max(std::abs(tile.origin.latitude_deg), std::abs(centre_.latitude_deg));
    const double east_deg = geo::wrapped_degrees(tile.origin.longitude_deg - centre_.longitude_deg) *
                            std::cos(latitude_deg * geo::kRadiansPerDegree);
    const double distance_m =
        geo::kMetresPerDegree * std::hypot(east_deg, tile.origin.latitude_deg - centre_.latitude_deg);
    const scene::Bounds& bounds = tile.bounds;
    const double extent_m = std::hypot(static_cast<double>(std::max(-bounds.east_min_m, bounds.east_max_m)),
                                       static_cast<double>(std::max(-bounds.north_min_m, bounds.north_max_m)));
    return distance_m > kReserve * (reach_m_ + extent_m);
  }

 private:
  geo::GeoPoint centre_;
  double reach_m_ = 0.0;  // of the grid from the map's centre
};

}  // namespace

std::vector<PlacedTile> place_tiles(const PatchGeometry& geometry, const PolarGrid& grid,
                                    const std::vector<const scene::Tile*>& tiles, const parallel::Executor& executor) {
  std::vector<PlacedTile> all(tiles.size());
  const FarTiles far(geometry, grid);
  parallel::parallel_for(executor, static_cast<int>(tiles.size()), kTilesPerTask,
                         [&](int first, int last, std::size_t) {
                           for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
                             if (far.has(*tiles[i])) continue;
                             all[i] = placed_tile(geometry, *tiles[i]);
                             if (!find_columns(geometry, grid, all[i])) all[i].tile = nullptr;
                           }
                         });
  std::erase_if(all, [](const PlacedTile& tile) { return tile.tile == nullptr; });
  return all;
}

std::vector<int> even_bands(const PolarGrid& grid, std::span<const PlacedTile> tiles, int bands) {
  std::vector<double> work(static_cast<std::size_t>(grid.strips()), 1.0);
  const auto strip_of = [&](float column) {
    return std::clamp(static_cast<int>(column) / kStripColumns, 0, grid.strips() - 1);
  };
  for (const PlacedTile& tile : tiles) {
    const int first = strip_of(std::max(tile.min_column, 0.0F));
    const int last = strip_of(std::min(tile.max_column, static_cast<float>(grid.columns)));
    const auto triangles = static_cast<double>(tile.tile->triangles());
    for (int strip = first; strip <= last; ++strip)
      work[static_cast<std::size_t>(strip)] += triangles / (last - first + 1);
  }
  const double sum = std::accumulate(work.begin() + grid.first_strip, work.begin() + grid.end_strip, 0.0);
  std::vector<int> begin{grid.first_strip};
  double done = 0.0;
  for (int strip = grid.first_strip; strip < grid.end_strip; ++strip) {
    const auto next = static_cast<double>(begin.size());
    if (done >= next * sum / bands && begin.size() < static_cast<std::size_t>(bands)) begin.push_back(strip);
    done += work[static_cast<std::size_t>(strip)];
  }
  begin.resize(static_cast<std::size_t>(bands) + 1, grid.end_strip);
  return begin;
}

SceneRaster::SceneRaster(const physics::SceneSurface& surface)
    : surface_(surface), cardinal_effect_(surface_.cardinal_effect_table()) {}

void SceneRaster::transform(const PatchGeometry& geometry, const PolarGrid& grid, const PlacedTile& placement) {
  const scene::Tile& tile = *placement.tile;
  const std::size_t count = tile.east_m.size();
  for (std::vector<float>* numbers : {&column_, &row_, &height_m_, &facing_})
    if (numbers->size() < count) numbers->resize(count);
  simd::VertexMap map{};
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
  map.columns_per_tangent = static_cast<float>(1.0 / grid.tangent_step);
  map.middle_column = static_cast<float>(-grid.first_tangent / grid.tangent_step);
  map.rows_per_metre = static_cast<float>(1.0 / grid.spacing_m);
  map.middle_row = static_cast<float>((geometry.distance_m() - grid.first_distance_m) / grid.spacing_m);
  simd::transform_vertices(count,
                           {tile.east_m.data(), tile.north_m.data(), tile.up_m.data(), tile.normal_east.data(),
                            tile.normal_north.data(), tile.normal_up.data()},
                           map, vertices_of(tile));
}

void SceneRaster::read_kinds(const scene::SceneView& scene) {
  gamma_.clear();
  cardinal_.clear();
  material_.clear();
  for (const scene::SurfaceKind& kind : scene.kinds()) {
    gamma_.push_back(static_cast<float>(surface_.gamma(kind.material)));
    cardinal_.push_back(static_cast<float>(surface_.cardinal(kind.material)));
    material_.push_back(kind.material);
  }
}

void SceneRaster::draw(const PatchGeometry& geometry, const PolarGrid& grid, const scene::SceneView& scene,
                       std::span<const PlacedTile> tiles, int first, int last, const simd::SceneArrays& arrays) {
  read_kinds(scene);
  simd::Canvas canvas;
  canvas.grid = &grid;
  canvas.arrays = arrays;
  canvas.cardinal = {cardinal_effect_, static_cast<float>(surface_.steps_per_sine())};
  simd::GridLimits& limits = canvas.limits;
  limits.first_column = static_cast<float>(first);
  limits.last_column = static_cast<float>(last);
  limits.first_row = -simd::kSurfaceReach;
  limits.last_row = static_cast<float>(grid.rows);
  limits.row_spacing_m = static_cast<float>(grid.spacing_m);
  limits.wall_normal2 = static_cast<float>(scene::kWallNormal2);
  for (const PlacedTile& placement : tiles) {
    if (!(placement.max_column >= limits.first_column && placement.min_column < limits.last_column)) continue;
    const double distance_m = std::hypot(placement.right_m, placement.up_m + geometry.distance_m());
    const double tangent = placement.right_m / std::max(placement.up_m + geometry.distance_m(), 1.0);
    limits.column_width_m = static_cast<float>(distance_m * grid.tangent_step / (1.0 + tangent * tangent));
    limits.sine = placement.toward_up;
    limits.cosine = std::sqrt(1.0F - placement.toward_up * placement.toward_up);
    transform(geometry, grid, placement);
    draw_tile(*placement.tile, canvas);
  }
}

void SceneRaster::draw_tile(const scene::Tile& tile, const simd::Canvas& canvas) {
  const simd::GridVertices vertices = vertices_of(tile);
  const simd::Corners corners{tile.corner[0].data(), tile.corner[1].data(), tile.corner[2].data()};
  const simd::TileSurfaces surfaces{tile.kind.data(), tile.object.data(), material_.data(), gamma_.data(),
                                    cardinal_.data()};
  simd::select_triangles(0, tile.on_ground, corners, vertices, canvas.limits, found_);
  simd::paint_ground(found_, surfaces, vertices, canvas);
  simd::select_triangles(tile.on_ground, tile.triangles(), corners, vertices, canvas.limits, found_);
  simd::draw_standing(found_, surfaces, vertices, canvas, fragments_);
}

void PolarScene::begin(const PatchData& data) {
  placed_.clear();
  drawn_ = !data.tiles.empty();
  if (!drawn_) return;
  const std::size_t before = walls_.size();
  walls_.resize(data.points);
  if (!dirty_ && walls_.size() == before) return;
  std::fill_n(walls_.data(), walls_.size(), WallPoint());
  dirty_ = false;
}

void PolarScene::draw(const PatchInputs& inputs, PatchData& data, SurfacePoint* surface) {
  if (!drawn_) return;
  dirty_ = true;
  const parallel::Executor& executor = inputs.executor;
  while (rasters_.size() < executor.threads) rasters_.emplace_back(surface_);
  // A tile that crosses bands is drawn once for each band, so few bands save work. Two bands per thread balance the
  // load.
  const auto bands = static_cast<int>(executor.threads == 1 ? 1 : 2 * executor.threads);
  if (placed_.empty()) placed_ = place_tiles(*data.geometry, data.grid, data.tiles, executor);
  const std::vector<int> begin = even_bands(data.grid, placed_, bands);
  parallel::parallel_for(executor, bands, 1, [&](int first, int last, std::size_t thread) {
    for (auto band = static_cast<std::size_t>(first); band < static_cast<std::size_t>(last); ++band)
      rasters_[thread].draw(*data.geometry, data.grid, *inputs.environment.scene, placed_, begin[band] * kStripColumns,
                            begin[band + 1] * kStripColumns, {surface, walls_.data(), data.labels.surface_labels()});
  });
}

}  // namespace yars::model::hrm
