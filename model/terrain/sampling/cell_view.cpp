#include "model/terrain/sampling/cell_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/sampling/crests_simd.hpp"
#include "model/terrain/sampling/cubic_simd.hpp"
#include "model/terrain/sampling/height_simd.hpp"

namespace yars::model::terrain {

namespace {

// Position between posts: the post to the south-west, and the fractions of the intervals north and east of it [0, 1].
struct Position {
  int row, column;
  double north, east;
};

Position position_in(const Cell& cell, double north_deg, double east_deg) {
  const double row = std::clamp(north_deg, 0.0, 1.0) * (cell.rows() - 1);
  const double column = std::clamp(east_deg, 0.0, 1.0) * (cell.columns() - 1);
  const int south = std::min(static_cast<int>(row), cell.rows() - 2);
  const int west = std::min(static_cast<int>(column), cell.columns() - 2);
  return {south, west, row - south, column - west};
}

Surface bilinear(const Cell& cell, const Position& at) {
  double total = 0.0;
  double height = 0.0;  // [unit_m]
  double water = 0.0;
  for (const int up : {0, 1})
    for (const int right : {0, 1}) {
      const std::int16_t post = cell.post(at.row + up, at.column + right);
      if (post == kVoidPost) continue;
      const double weight = (up == 1 ? at.north : 1 - at.north) * (right == 1 ? at.east : 1 - at.east);
      total += weight;
      height += weight * post;
      if (post == 0) water += weight;
    }
  if (total <= 0.0) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  return {height / total * cell.unit_m(), water / total};
}

// Catmull-Rom weights of four posts. t: position from the second post (0) to the third (1).
std::array<double, 4> cubic_weights(double t) {
  return {0.5 * t * ((2.0 - t) * t - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0), 0.5 * t * ((4.0 - 3.0 * t) * t + 1.0),
          0.5 * t * t * (t - 1.0)};
}

std::optional<double> cubic_height_m(const Cell& cell, const Position& at) {
  const std::array<double, 4> along = cubic_weights(at.north);
  const std::array<double, 4> across = cubic_weights(at.east);
  double height = 0.0;  // [unit_m]
  for (std::size_t up = 0; up < 4; ++up)
    for (std::size_t right = 0; right < 4; ++right) {
      const int row = std::clamp(at.row + static_cast<int>(up) - 1, 0, cell.rows() - 1);
      const int column = std::clamp(at.column + static_cast<int>(right) - 1, 0, cell.columns() - 1);
      const std::int16_t post = cell.post(row, column);
      if (post == kVoidPost) return std::nullopt;
      height += along[up] * across[right] * post;
    }
  return height * cell.unit_m();
}

}  // namespace

Surface interpolate(const Cell& cell, double north_deg, double east_deg, radar::Interpolation interpolation) {
  Position at = position_in(cell, north_deg, east_deg);
  if (interpolation == radar::Interpolation::nearest) {
    at.north = at.north >= 0.5 ? 1.0 : 0.0;
    at.east = at.east >= 0.5 ? 1.0 : 0.0;
  }
  Surface surface = bilinear(cell, at);
  if (interpolation != radar::Interpolation::cubic) return surface;
  if (const std::optional<double> height_m = cubic_height_m(cell, at)) surface.elevation_m = surface.peak_m = *height_m;
  return surface;
}

namespace {

// Largest divisor of the old number of intervals that leaves at least the new number; 1 if the new grid is finer.
int whole_factor(int old_posts, int new_posts) {
  const int old_intervals = old_posts - 1;
  for (int factor = old_intervals / (new_posts - 1); factor > 1; --factor)
    if (old_intervals % factor == 0) return factor;
  return 1;
}

// Post for a surface, in units of `unit_m`. The value 0 means sea, so land that rounds to 0 becomes -1 or 1.
std::int16_t rounded(const Surface& surface, double unit_m) {
  if (std::isnan(surface.elevation_m)) return kVoidPost;
  if (surface.water > 0.5) return 0;
  const long units = std::lround(surface.elevation_m / unit_m);
  if (units != 0) return static_cast<std::int16_t>(units);
  return surface.elevation_m < 0 ? std::int16_t{-1} : std::int16_t{1};
}

}  // namespace

Cell resample(const Cell& cell, int rows, int columns) {
  YARS_REQUIRE(rows, >=, 2);
  YARS_REQUIRE(columns, >=, 2);
  if (rows == cell.rows() && columns == cell.columns()) return cell;
  Cell means = reduce_by(cell, whole_factor(cell.rows(), rows), whole_factor(cell.columns(), columns)).means;
  if (rows == means.rows() && columns == means.columns()) return means;
  std::vector<std::int16_t> posts;
  posts.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      posts.push_back(rounded(
          interpolate(means, static_cast<double>(row) / (rows - 1), static_cast<double>(column) / (columns - 1)),
          cell.unit_m()));
  return {cell.corner(), rows, columns, posts, cell.unit_m()};
}

namespace {

constexpr Surface kVoidSurface{std::numeric_limits<double>::quiet_NaN(), 0.0};
// Limit of PositionRun's cell counts. Positions beyond the limit are void, because larger counts could overflow an int.
constexpr float kMaxCellSteps = 1.0e6F;

// [m] The smaller of the row spacing and the column spacing along the edge nearer to a pole.
double spacing_m(const Cell& cell) {
  const int south_deg = cell.corner().south_deg;
  const double farthest_deg = std::max(std::abs(south_deg), std::abs(south_deg + 1));
  const double east_deg = std::max(0.0, std::cos(farthest_deg * geo::kRadiansPerDegree)) / (cell.columns() - 1);
  return geo::kMetresPerDegree * std::min(1.0 / (cell.rows() - 1), east_deg);
}

// [m] Step along a ray in a cell: the minimum spacing of posts, clamped to [1/3, 1] times the row spacing. The reason
// for 1/3: toward a pole the columns converge, although the data do not become finer.
double walked_spacing_m(const Cell& cell) {
  const double rows_m = geo::kMetresPerDegree / (cell.rows() - 1);
  return std::clamp(spacing_m(cell), rows_m / 3.0, rows_m);
}

// `culture`: null, or that of the cell.
sampling::Grid grid_of(const Cell& cell, const Culture* culture = nullptr) {
  const bool same_posts = culture != nullptr && culture->rows() == cell.rows() && culture->columns() == cell.columns();
  return {
      &cell.blocks(),   &cell.ceilings(),     same_posts ? &culture->blocks() : nullptr, cell.rows(), cell.columns(),
      cell.voids() > 0, cell.sea_posts() > 0, static_cast<float>(cell.unit_m())};
}

// [m] Spacing of the distances if it is the same everywhere, else 0.
float even_spacing_m(std::span<const float> distance_m) {
  if (distance_m.size() < 3) return 0.0F;
  const std::size_t last = distance_m.size() - 1;
  const float rounding_m = 0.01F + 2e-7F * distance_m[last];
  const float step_m = (distance_m[last] - distance_m[0]) / static_cast<float>(last);
  for (const std::size_t i : {std::size_t{1}, last / 4, last / 2})
    if (std::abs(distance_m[0] + static_cast<float>(i) * step_m - distance_m[i]) > rounding_m) return 0.0F;
  return step_m;
}

// The observer's part of a ray.
crests::Ray ray_of(const RaySight& sight) {
  crests::Ray ray;
  ray.curvature = static_cast<float>(sight.curvature);
  ray.series = sight_series(sight);
  // Less a thousandth of the drop for the series and rounding; the growth of the lift is greater on low ground.
  constexpr double kLowGround = 1.3;
  ray.least_fall = static_cast<float>(0.4995 * sight.curvature - 1.001 * sight.lift.level);
  ray.lift_per_height = static_cast<float>(sight.lift.per_height);
  ray.lift_per_square = static_cast<float>(kLowGround * std::max(0.0, sight.lift.per_square));
  return ray;
}

}  // namespace

namespace {

// The cells that have a position on the south or west edge of a cell on an edge of theirs, too. Empty for any other
// position. Degrees are from the cell's south-west corner.
std::vector<CellCorner> sharing_edge(CellCorner corner, double north_deg, double east_deg) {
  const bool on_south = north_deg == 0.0 && corner.south_deg > -90, on_west = east_deg == 0.0;
  const int south_deg = corner.south_deg - 1;
  const int west_deg = corner.west_deg > -kCellColumns / 2 ? corner.west_deg - 1 : kCellColumns / 2 - 1;
  std::vector<CellCorner> cells;
  if (on_south) cells.push_back({south_deg, corner.west_deg});
  if (on_west) cells.push_back({corner.south_deg, west_deg});
  if (on_south && on_west) cells.push_back({south_deg, west_deg});
  return cells;
}

}  // namespace

CellView::CellView(std::uint64_t generation, Absence elsewhere, int detail) : generation_(generation), detail_(detail) {
  table_.fill(static_cast<std::uint16_t>(elsewhere));
}

void CellView::set_absence(CellCorner corner, Absence absence) {
  table_[slot_of(corner)] = static_cast<std::uint16_t>(absence);
}

void CellView::add(TerrainCell cell) {
  table_[slot_of(cell.heights->corner())] = static_cast<std::uint16_t>(kFirstCell + cells_.size());
  resident_bytes_ += cell.heights->bytes();
  const double posts_m = spacing_m(*cell.heights);
  post_spacing_m_ = cells_.empty() ? posts_m : std::min(post_spacing_m_, posts_m);
  if (cell.peaks) {
    resident_bytes_ += cell.peaks->bytes();
    has_peaks_ = true;
  }
  if (cell.culture) {
    resident_bytes_ += cell.culture->bytes();
    has_materials_ = true;
  }
  const double ray_step_m = walked_spacing_m(*cell.heights);
  spacings_.push_back({static_cast<float>(ray_step_m), posts_m < ray_step_m});
  cells_.push_back(std::move(cell));
}

Surface CellView::surface_at(geo::GeoPoint position, Interpolation interpolation) const {
  if (!std::isfinite(position.latitude_deg) || !std::isfinite(position.longitude_deg)) return kVoidSurface;
  const CellCorner corner = cell_containing(position);
  const double north_deg = position.latitude_deg - corner.south_deg;
  const double east_deg = geo::wrapped_degrees(position.longitude_deg) - corner.west_deg;
  const Surface surface = surface_in(corner, north_deg, east_deg, interpolation);
  if (!std::isnan(surface.elevation_m) || entry(corner) < kFirstCell) return surface;
  for (const CellCorner across : sharing_edge(corner, north_deg, east_deg)) {
    if (entry(across) < kFirstCell) continue;
    const Surface shared = surface_in(across, across.south_deg == corner.south_deg ? north_deg : 1.0,
                                      across.west_deg == corner.west_deg ? east_deg : 1.0, interpolation);
    if (!std::isnan(shared.elevation_m)) return shared;
  }
  return surface;
}

// The ground of a cell at degrees from its south-west corner.
Surface CellView::surface_in(CellCorner corner, double north_deg, double east_deg, Interpolation interpolation) const {
  const std::uint16_t table_entry = entry(corner);
  if (table_entry == static_cast<std::uint16_t>(Absence::sea)) return {0.0, 1.0};
  if (table_entry < kFirstCell) {
    Surface nothing = kVoidSurface;
    nothing.loaded = table_entry != static_cast<std::uint16_t>(Absence::not_loaded);
    return nothing;
  }
  const TerrainCell& cell = cells_[table_entry - kFirstCell];
  Surface surface = interpolate(*cell.heights, north_deg, east_deg, interpolation);
  if (cell.peaks) {
    // Peaks are an upper bound of the ground. A cubic between peaks could be below the ground, so bilinear replaces it.
    const bool nearest = interpolation == Interpolation::nearest;
    surface.peak_m =
        interpolate(*cell.peaks, north_deg, east_deg, nearest ? Interpolation::nearest : Interpolation::bilinear)
            .elevation_m;
  }
  if (cell.culture) {
    const Cover cover = cell.culture->nearest(north_deg, east_deg);
    surface.material = cover.material;
    surface.water = cover.water.value_or(surface.water);
  }
  return surface;
}

PostSpacing CellView::post_spacing_at(geo::GeoPoint position) const {
  const std::uint16_t table_entry = entry(cell_containing(position));
  if (table_entry < kFirstCell) return {};
  const Cell& cell = *cells_[table_entry - kFirstCell].heights;
  return {walked_spacing_m(cell), 1.0 / (cell.rows() - 1), 1.0 / (cell.columns() - 1)};
}

std::vector<std::shared_ptr<const Cell>> CellView::cells_within(const GeoBox& box) const {
  std::vector<std::shared_ptr<const Cell>> found;
  const auto first_of = [](double edge_deg) { return static_cast<int>(std::floor(edge_deg)); };
  const int last_west = std::min(first_of(box.east_deg), first_of(box.west_deg) + kCellColumns - 1);
  for (int south = std::max(first_of(box.south_deg), -90); south <= std::min(first_of(box.north_deg), 89); ++south)
    for (int west = first_of(box.west_deg); west <= last_west; ++west) {
      const std::uint16_t table_entry = entry(cell_containing({south + 0.5, geo::wrapped_degrees(west + 0.5)}));
      if (table_entry >= kFirstCell) found.push_back(cells_[table_entry - kFirstCell].heights);
    }
  return found;
}

CellView::Run CellView::run_at(const PositionRun& positions, std::size_t first) const {
  Run run;
  run.first = first;
  const float cells_north = positions.cells_north[first];
  const float cells_east = positions.cells_east[first];
  if (!(std::abs(cells_north) <= kMaxCellSteps) || !(std::abs(cells_east) <= kMaxCellSteps)) return run;
  const int south = positions.corner.south_deg + static_cast<int>(cells_north);
  const int west = positions.corner.west_deg + 180 + static_cast<int>(cells_east);
  run.beyond_pole = south < -90 || south > 89;
  run.table_entry =
      entry({std::clamp(south, -90, 89), (west % kCellColumns + kCellColumns) % kCellColumns - kCellColumns / 2});
  run.count = sampling::same_cell_count(&positions.cells_north[first], &positions.cells_east[first],
                                        positions.cells_north.size() - first);
  return run;
}

// Samples one position at a time. Used at a pole, where positions can be beyond all cells.
void CellView::sample_singly(const Run& run, const PositionRun& positions, Interpolation interpolation,
                             const SurfaceRun& found) const {
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
    const Surface surface = surface_at(position_of(positions, i), interpolation);
    found.elevation_m[i] = static_cast<float>(surface.elevation_m);
    found.water[i] = static_cast<float>(surface.water);
  }
}

// NearGround in a cell, in the direction from the run's first position to its last.
sampling::Near CellView::near_ground(const Run& run, const PositionRun& positions, const NearGround& near) const {
  if (near.height_m.empty() || run.count < 2 || run.beyond_pole) return {};
  constexpr float kSpacings = 0.1F;
  const TerrainCell& cell = cells_[run.table_entry - kFirstCell];
  const Spacing& spacing = spacings_[run.table_entry - kFirstCell];
  const float back_m = kSpacings * spacing.ray_step_m;
  // Where columns are close, the direction of a ray changes within a cell, and crests() samples this ground itself.
  if (spacing.close_columns || !(back_m < near.step_m)) return {};
  std::fill_n(&near.back_m[run.first], run.count, back_m);
  const Cell& grid = cell.peaks ? *cell.peaks : *cell.heights;
  const std::size_t last = run.first + run.count - 1;
  const float part = back_m / (near.step_m * static_cast<float>(run.count - 1));
  return {part * (positions.north_deg[last] - positions.north_deg[run.first]) * static_cast<float>(grid.rows() - 1),
          part * (positions.east_deg[last] - positions.east_deg[run.first]) * static_cast<float>(grid.columns() - 1),
          &near.height_m[run.first]};
}

void CellView::sample_run(const Run& run, const PositionRun& positions, Interpolation interpolation,
                          const SurfaceRun& found) const {
  const TerrainCell& cell = cells_[run.table_entry - kFirstCell];
  const float* const north_deg = &positions.north_deg[run.first];
  const float* const east_deg = &positions.east_deg[run.first];
  const bool nearest = interpolation == Interpolation::nearest;
  const sampling::Near near = near_ground(run, positions, found.near);
  const sampling::Grid grid = grid_of(*cell.heights, cell.culture.get());
  std::int32_t* const material = found.material.empty() || !cell.culture ? nullptr : &found.material[run.first];
  const bool with_heights = grid.codes != nullptr && !run.beyond_pole;
  if (run.beyond_pole) {
    sample_singly(run, positions, interpolation, found);
  } else {
    float* const elevation_m = &found.elevation_m[run.first];
    sampling::heights(grid, north_deg, east_deg, run.count, nearest,
                      {elevation_m, &found.water[run.first], with_heights ? material : nullptr,
                       cell.peaks ? sampling::Near{} : near});
    if (interpolation == Interpolation::cubic)
      sampling::cubic_heights(grid, north_deg, east_deg, run.count, elevation_m);
  }
  if (material != nullptr && !with_heights) sampling::codes(*cell.culture, north_deg, east_deg, run.count, material);
  if (material != nullptr && cell.culture->has_water())
    sampling::unpack_covers(run.count, material, &found.water[run.first]);
  if (found.peak_m.empty()) return;
  if (cell.peaks)
    sampling::heights(grid_of(*cell.peaks), north_deg, east_deg, run.count, nearest,
                      {&found.peak_m[run.first], nullptr, nullptr, near});
  else
    std::copy_n(&found.elevation_m[run.first], run.count, &found.peak_m[run.first]);
}

// Takes the heights of void positions on the south or west edge of the run's cell from the cells that share the edge.
void CellView::fill_edges(const Run& run, const PositionRun& positions, Interpolation interpolation,
                          const SurfaceRun& found) const {
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
    if (positions.north_deg[i] != 0.0F && positions.east_deg[i] != 0.0F) continue;
    if (!std::isnan(found.elevation_m[i])) continue;
    const Surface surface = surface_at(position_of(positions, i), interpolation);
    if (std::isnan(surface.elevation_m)) continue;
    found.elevation_m[i] = static_cast<float>(surface.elevation_m);
    found.water[i] = static_cast<float>(surface.water);
    if (!found.peak_m.empty()) found.peak_m[i] = static_cast<float>(surface.peak_m);
  }
}

std::size_t CellView::surfaces(const PositionRun& positions, Interpolation interpolation,
                               const SurfaceRun& found) const {
  const std::size_t count = positions.north_deg.size();
  YARS_REQUIRE(positions.east_deg.size(), ==, count);
  YARS_REQUIRE(positions.cells_north.size(), ==, count);
  YARS_REQUIRE(positions.cells_east.size(), ==, count);
  YARS_REQUIRE(found.elevation_m.size(), ==, count);
  YARS_REQUIRE(found.water.size(), ==, count);
  std::size_t not_loaded = 0;
  for (std::size_t first = 0; first < count;) {
    const Run run = run_at(positions, first);
    // The run before may have written here.
    if (!found.material.empty()) std::fill_n(&found.material[first], run.count, 0);
    if (!found.near.height_m.empty())
      std::fill_n(&found.near.height_m[first], run.count, std::numeric_limits<float>::quiet_NaN());
    if (run.table_entry >= kFirstCell) {
      sample_run(run, positions, interpolation, found);
      if (cells_[run.table_entry - kFirstCell].heights->voids() > 0) fill_edges(run, positions, interpolation, found);
    } else {
      const bool sea = run.table_entry == static_cast<std::uint16_t>(Absence::sea);
      const float height_m = sea ? 0.0F : std::numeric_limits<float>::quiet_NaN();
      std::fill_n(&found.elevation_m[first], run.count, height_m);
      std::fill_n(&found.water[first], run.count, sea ? 1.0F : 0.0F);
      if (!found.peak_m.empty()) std::fill_n(&found.peak_m[first], run.count, height_m);
      if (run.table_entry == static_cast<std::uint16_t>(Absence::not_loaded)) not_loaded += run.count;
    }
    first += run.count;
  }
  return not_loaded;
}

// The cell of position `i` for crests::raise(). If the cell is reduced, its peaks are used, because the highest ground
// casts the shadow.
crests::CrossedCell CellView::crossed(const Run& run, const PositionRun& positions, std::size_t i) const {
  const TerrainCell& cell = cells_[run.table_entry - kFirstCell];
  const Spacing& spacing = spacings_[run.table_entry - kFirstCell];
  return {grid_of(cell.peaks ? *cell.peaks : *cell.heights), positions.cells_north[i], positions.cells_east[i],
          spacing.ray_step_m, spacing.close_columns};
}

bool CellView::crests(const PositionRun& positions, const RaySight& sight, std::span<float> tangent) const {
  const std::size_t count = positions.north_deg.size();
  YARS_REQUIRE(sight.distance_m.size(), ==, count);
  YARS_REQUIRE(tangent.size(), ==, count);
  std::fill(tangent.begin(), tangent.end(), kNoTangent);
  crests::Ray ray = ray_of(sight);
  ray.cells_north = positions.cells_north.data();
  ray.cells_east = positions.cells_east.data();
  ray.north_deg = positions.north_deg.data();
  ray.east_deg = positions.east_deg.data();
  ray.distance_m = sight.distance_m.data();
  if (!sight.horizon.empty()) {
    ray.floor = sight.horizon.data();
    ray.even_step_m = even_spacing_m(sight.distance_m);
  }
  for (std::size_t first = 0; first < count;) {
    const Run run = run_at(positions, first);
    const std::size_t behind = first + run.count;
    if (run.table_entry >= kFirstCell && !run.beyond_pole) {
      // The step into this cell and the step out of it each lie partly in a neighbouring cell. raise() examines their
      // parts in this cell.
      crests::raise(crossed(run, positions, first), ray, std::max<std::size_t>(first, 1), std::min(behind + 1, count),
                    tangent.data());
    }
    first = behind;
  }
  if (count > 1) raise_first_crest(positions, sight, tangent[0]);
  return true;
}

// Examines the step from the start of the ray to the first position. The coordinates of the start are extrapolated
// backward from the step that follows.
void CellView::raise_first_crest(const PositionRun& positions, const RaySight& sight, float& tangent) const {
  const float step_m = sight.distance_m[1] - sight.distance_m[0];
  if (!(step_m > 0.0F) || !(sight.distance_m[0] > 0.0F)) return;
  const Run run = run_at(positions, 0);
  if (run.table_entry < kFirstCell || run.beyond_pole) return;
  const float fraction = sight.distance_m[0] / step_m;
  using Two = std::array<float, 2 + kRunSlack>;
  const auto back = [&](std::span<const float> cells, std::span<const float> degrees) {
    // Near a pole the cell counts of neighbouring positions may differ by 360.
    const float cells_on = std::remainder(cells[1] - cells[0], 360.0F);
    return degrees[0] - fraction * (cells_on + (degrees[1] - degrees[0]));
  };
  const Two cells_north{positions.cells_north[0], positions.cells_north[0]};
  const Two cells_east{positions.cells_east[0], positions.cells_east[0]};
  const Two north_deg{back(positions.cells_north, positions.north_deg), positions.north_deg[0]};
  const Two east_deg{back(positions.cells_east, positions.east_deg), positions.east_deg[0]};
  const Two distance_m{0.0F, sight.distance_m[0]};
  crests::Ray ray = ray_of(sight);
  ray.cells_north = cells_north.data();
  ray.cells_east = cells_east.data();
  ray.north_deg = north_deg.data();
  ray.east_deg = east_deg.data();
  ray.distance_m = distance_m.data();
  Two found{};
  found.fill(kNoTangent);
  crests::raise(crossed(run, positions, 0), ray, 1, 2, found.data());
  tangent = std::max(tangent, found[1]);
}

}  // namespace yars::model::terrain
