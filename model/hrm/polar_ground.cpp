#include "model/hrm/polar_ground.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/hrm/map_image.hpp"
#include "model/hrm/polar_ground_simd.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

namespace {
// Spacing [m] of the samples on the path, which is the ground from the aircraft to the grid. Without posts only the
// samples raise the horizon. With posts the lines of posts between samples raise it too, so samples may be farther
// apart. Over 500 m a path is straight in latitude and longitude within 5 mm. A larger spacing would misplace crests.
constexpr double kPathSpacingWithoutPosts_m = 60.0;
constexpr double kPathSpacingWithPosts_m = 500.0;
constexpr double kMaxPathSamples = 4096.0;  // bounds the work of a column
constexpr float kNoHorizon = -1.0e6F;       // [m] or tangent: below every line of sight and below all ground
// Maximum spacing of sampled columns as a fraction of the post spacing, in the window and on the path to it. If posts
// are many columns apart, only every third or fifth column is sampled, and the columns between are interpolated. The
// first and the last column of a strip are always sampled. kMaxPathStep is larger, because the path affects only the
// horizon.
constexpr double kMaxWindowStep = 0.25;
constexpr double kMaxHeightStep = 0.125;  // for heights alone, over surface materials
constexpr double kMaxPathStep = 0.5;
// Row spacings, as fractions of the post spacing, above which crests between rows are computed. Closer rows sample
// every crest themselves. In a smoothed view, one-degree cells with close posts stay bilinear, so crests lie on their
// lines of posts.
constexpr double kLineCrestSpacing = 0.2;    // crests on lines of posts, in a view that is not smoothed
constexpr double kSummitCrestSpacing = 0.1;  // summits, in a smoothed view
constexpr double kSmoothLineSpacing = 0.5;   // crests on lines of posts, in a smoothed view

// Step between sampled columns: 5 or 3, the larger one whose spacing is at most `farthest_m`, else 1. `width_m`: column
// width.
int step_within(double farthest_m, double width_m) {
  for (const int step : {5, 3})
    if (step * width_m <= farthest_m) return step;
  return 1;
}

// Interpolates the horizons of the columns between the sampled ones. In this file a lane is the number of a column
// within its strip.
void interpolate_horizons(int step, float* horizon) {
  for (int lane = 0; lane < kStripColumns; ++lane) {
    const int off = lane % step;
    if (off == 0) continue;
    const float first = horizon[lane - off];
    const float second = horizon[lane - off + step];
    horizon[lane] = first + static_cast<float>(off) / static_cast<float>(step) * (second - first);
  }
}
}  // namespace

CrestsBetweenRows crests_between_rows(const PolarGrid& grid, const terrain::TerrainView& window, bool smooth) {
  const double posts_m = window.post_spacing_m();
  if (!(posts_m > 0.0)) return {};
  return {grid.spacing_m > (smooth ? kSmoothLineSpacing : kLineCrestSpacing) * posts_m,
          smooth && grid.spacing_m > kSummitCrestSpacing * posts_m};
}

PolarGround::Sight::Sight(const PatchGeometry& geometry, double distance_m) {
  const PatchGeometry::SightLine line = geometry.sight_line(distance_m);
  above_m = static_cast<float>(line.above_m);
  chord_m = static_cast<float>(line.chord_m);
  sine = static_cast<float>(line.sine);
  cosine = static_cast<float>(line.cosine);
  bow = static_cast<float>(line.bow);
  const PatchGeometry::PlaneSight plane = geometry.plane_sight(distance_m);
  above_plane_m = static_cast<float>(plane.above_m);
  this->distance_m = static_cast<float>(plane.distance_m);
}

PolarGround::Column::Column(std::size_t samples)
    : positions(samples),
      distance_m(samples + terrain::kRunSlack),
      elevation_m(distance_m.size()),
      water(distance_m.size()),
      peak_m(distance_m.size()),
      crest(distance_m.size()) {}

PolarGround::PolarGround(const physics::RadarParameters& parameters)
    : algorithm_(parameters.algorithm),
      interpolation_(parameters.interpolation),
      geodesic_knots_(parameters.geometry.geodesic_knots),
      ground_(std::make_unique<physics::Ground>(parameters, 0)),
      plain_gamma_(static_cast<float>(physics::make_land_return(parameters).gamma[0])) {}

void PolarGround::begin(const PatchGeometry& geometry, const PolarGrid& grid, const terrain::TerrainView& path) {
  const auto rows = static_cast<std::size_t>(grid.rows);
  if (!window_ || window_->positions.count != rows) {
    window_ = std::make_unique<Column>(rows);
    ground_->resize(rows);
    sin_grazing_.assign(rows + terrain::kRunSlack, 0.0F);
    sea_divisor_.assign(sin_grazing_.size(), 0.0F);
    // The pitch is an odd multiple of kRunSlack, so that a row of sixteen columns is spread over different cache sets.
    pitch_ = (rows / terrain::kRunSlack + 1) * terrain::kRunSlack;
    if (pitch_ / terrain::kRunSlack % 2 == 0) pitch_ += terrain::kRunSlack;
    strip_height_.assign(kStripColumns * pitch_ + terrain::kRunSlack, 0.0F);
    strip_gamma_.assign(strip_height_.size(), 0.0F);
    strip_crest_.clear();
  }
  row_sight_.clear();
  for (std::size_t row = 0; row < window_->distance_m.size(); ++row) {
    const double distance_m = grid.distance_m(static_cast<double>(std::min(row, rows - 1)));
    window_->distance_m[row] = static_cast<float>(distance_m);
    row_sight_.emplace_back(geometry, distance_m);
    const double above_m = geometry.altitude_m() - geometry.plane_msl_m();
    sin_grazing_[row] =
        static_cast<float>(std::max(0.0, geometry.earth_above_plane().sight(above_m, distance_m, 0.0).sin_grazing));
    sea_divisor_[row] = sin_grazing_[row] > 0.0F ? sin_grazing_[row] : std::numeric_limits<float>::infinity();
  }
  const double path_m = grid.first_distance_m;
  const double spacing_m = path.post_spacing_m() > 0.0 ? kPathSpacingWithPosts_m : kPathSpacingWithoutPosts_m;
  const auto samples = static_cast<std::size_t>(std::clamp(std::ceil(path_m / spacing_m), 1.0, kMaxPathSamples));
  if (!path_ || path_->positions.count != samples) path_ = std::make_unique<Column>(samples);
  // The last sample is at row 0 and does not belong to the path.
  path_sight_.clear();
  for (std::size_t i = 0; i < path_->distance_m.size(); ++i) {
    const double fraction = (static_cast<double>(std::min(i, samples - 1)) + 1.0) / static_cast<double>(samples);
    path_->distance_m[i] = static_cast<float>(fraction * path_m);
    path_sight_.emplace_back(geometry, fraction * path_m);
  }
  ground_->use_texture({.pulse_length_m = grid.spacing_m, .spacing_m = grid.spacing_m});
}

std::size_t PolarGround::fill(const PatchOrder& order, const PatchGeometry& geometry, const PolarGrid& grid,
                              const PatchTerrain& terrain, const GroundTexture* detail, int first, int last,
                              const GroundArrays& arrays) {
  const int step = arrays.crest_m == nullptr ? column_step(grid, *terrain.window, detail) : 1;
  const int path_columns = path_step(grid, *terrain.path);
  const bool materials = terrain.window->has_materials();
  const terrain::TerrainView& posts = terrain.posts == nullptr ? *terrain.window : *terrain.posts;
  if (arrays.crest_m != nullptr) strip_crest_.resize(strip_height_.size());
  if (arrays.label != nullptr) strip_label_.resize(strip_height_.size());
  std::size_t pending = 0;
  for (int column = first; column < last; ++column) {
    const geo::Bearing azimuth = geometry.up() + geo::Angle::radians(std::atan(grid.tangent(column)));
    const int number = column % kStripColumns;
    const auto lane = static_cast<std::size_t>(number);
    if (number % path_columns == 0)
      pending += read_path(geometry, grid, azimuth, *terrain.path, arrays.horizon[column]);
    if (number % step == 0) {
      pending += read_window(order, geometry, azimuth, *terrain.window, detail, lane);
      subtract_plane(geometry, lane);
      if (arrays.crest_m != nullptr) read_crests(geometry, terrain, lane);
    } else if (materials) {
      pending += read_window(order, geometry, azimuth, posts, detail, lane);
      clear_voids(lane);
    }
    if (arrays.label != nullptr && (materials || number % step == 0)) read_labels(lane, materials);
    prefetch_strip(grid, column, arrays);
    if (number + 1 < kStripColumns) continue;
    if (step > 1) interpolate_columns(static_cast<std::size_t>(step), materials);
    store_strip(grid, column / kStripColumns, arrays);
    if (arrays.crest_m != nullptr) store_crests(grid, column / kStripColumns, arrays.crest_m);
    if (arrays.label != nullptr) store_labels(grid, column / kStripColumns, materials ? 1 : step, arrays.label);
    interpolate_horizons(path_columns, arrays.horizon + column + 1 - kStripColumns);
  }
  return pending;
}

// Step between the columns whose heights are sampled in the window. It is 1 with the interpolation `nearest` and for
// every algorithm except `standard`. Without materials gamma is sampled in the same columns, so they are at most a
// texel of the ground detail apart. Materials have sharp edges: with them gamma is sampled in every column.
int PolarGround::column_step(const PolarGrid& grid, const terrain::TerrainView& view,
                             const GroundTexture* detail) const {
  if (algorithm_ != radar::Algorithm::standard || interpolation_ == radar::Interpolation::nearest) return 1;
  double farthest_m = (view.has_materials() ? kMaxHeightStep : kMaxWindowStep) * view.post_spacing_m();
  if (detail != nullptr && !view.has_materials()) farthest_m = std::min(farthest_m, detail->texel_m());
  return step_within(farthest_m, grid.width_m(0.5 * grid.columns, grid.distance_m(grid.rows - 1)));
}

// Step between the columns sampled on the path. Without posts, every fifth column is enough.
int PolarGround::path_step(const PolarGrid& grid, const terrain::TerrainView& view) const {
  const double spacing_m = view.post_spacing_m();
  const double farthest_m = spacing_m > 0.0 ? kMaxPathStep * spacing_m : std::numeric_limits<double>::infinity();
  return step_within(farthest_m, grid.width_m(0.5 * grid.columns, grid.first_distance_m));
}

// Samples height (above mean sea level) and gamma of a column into strip_height_ and strip_gamma_. Vectors write a few
// entries beyond the column, which the next column overwrites.
std::size_t PolarGround::read_window(const PatchOrder& order, const PatchGeometry& geometry, geo::Bearing azimuth,
                                     const terrain::TerrainView& view, const GroundTexture* detail, std::size_t lane) {
  Column& column = *window_;
  const std::size_t rows = column.positions.count;
  float* height_m = &strip_height_[lane * pitch_];
  float* gamma = &strip_gamma_[lane * pitch_];
  const geo::Length range = geo::Length::metres(static_cast<double>(column.distance_m[rows - 1]));
  column.sampler.sample(geometry.apex(), azimuth, range, geodesic_knots_, column.distance_m.data(), column.positions);
  const terrain::SurfaceRun found{
      {height_m, rows},
      {column.water.data(), rows},
      {},
      view.has_materials() ? std::span(ground_->materials()).first(rows) : std::span<std::int32_t>{}};
  const std::size_t pending = view.surfaces(column.positions.run(), interpolation_, found);
  const physics::SweepGeometry sweep{geometry.apex(), order.altitude, azimuth,    {},
                                     range,           order.sim_time, order.band, order.channel};
  const physics::Ground::Sample reflects =
      ground_->reflect(sweep, column.positions.run(), column.water.data(), sin_grazing_.data(), view.has_materials());
  if (reflects.land != nullptr)
    std::copy_n(reflects.land, rows, gamma);
  else
    std::fill_n(gamma, rows, plain_gamma_);
  // The sea's sigma0 refers to level area. Division by the sine of the grazing angle converts it to gamma. The divisor
  // is infinite where sea has no return, so that the compiler uses vectors.
  if (reflects.sea != nullptr && physics::simd::any_positive(rows, reflects.sea))
    for (std::size_t row = 0; row < rows; ++row) gamma[row] += reflects.sea[row] / sea_divisor_[row];
  if (detail != nullptr) detail->modulate(column.positions.run(), gamma);
  return pending;
}

// Sets gamma 0 in the voids of the current column, whose heights will be interpolated.
void PolarGround::clear_voids(std::size_t lane) {
  const float* const height_m = &strip_height_[lane * pitch_];
  float* const gamma = &strip_gamma_[lane * pitch_];
  for (std::size_t row = 0; row < window_->positions.count; ++row)
    gamma[row] = std::isnan(height_m[row]) ? 0.0F : gamma[row];
}

std::size_t PolarGround::read_path(const PatchGeometry& geometry, const PolarGrid& grid, geo::Bearing azimuth,
                                   const terrain::TerrainView& view, float& horizon) {
  Column& column = *path_;
  const std::size_t samples = column.positions.count;
  column.sampler.sample(geometry.apex(), azimuth, geo::Length::metres(grid.first_distance_m), geodesic_knots_,
                        column.distance_m.data(), column.positions);
  const bool peaks = view.has_peaks();
  const terrain::SurfaceRun found{{column.elevation_m.data(), samples},
                                  {column.water.data(), samples},
                                  peaks ? std::span(column.peak_m).first(samples) : std::span<float>{},
                                  {}};
  const std::size_t pending = view.surfaces(column.positions.run(), interpolation_, found);
  const std::vector<float>& top_m = peaks ? column.peak_m : column.elevation_m;
  float tangent = terrain::kNoTangent;
  const auto plane_m = static_cast<float>(geometry.plane_msl_m());
  for (std::size_t i = 0; i + 1 < samples; ++i) {
    const Sight& sight = path_sight_[i];
    const float over_m = top_m[i] - plane_m;
    const float sample_tangent = (top_m[i] * sight.cosine - sight.above_m + sight.bow * over_m * over_m) /
                                 (sight.chord_m + top_m[i] * sight.sine);
    if (sample_tangent > tangent) tangent = sample_tangent;  // false for NaN, which marks a void
  }
  // Crests on the lines of posts between the samples also raise the horizon.
  const physics::EffectiveEarth& earth = geometry.earth();
  if (view.crests(column.positions.run(),
                  {geometry.altitude_m(),
                   earth.curvature(),
                   earth.lift().of_elevation,
                   std::span(column.distance_m).first(samples),
                   {}},
                  std::span(column.crest).first(samples)))
    tangent = std::max(
        tangent, *std::max_element(column.crest.begin(), column.crest.begin() + static_cast<std::ptrdiff_t>(samples)));
  horizon = kNoHorizon;
  if (tangent > terrain::kNoTangent) {
    // Horizons of rows use heights above the map plane. The height of the line of sight at row 0 converts the tangent.
    const double height_m = geometry.height_on_sight_m(grid.first_distance_m, static_cast<double>(tangent));
    const auto [above_m, sight_m] = geometry.plane_sight(grid.first_distance_m);
    horizon = static_cast<float>((height_m - above_m) / sight_m);
  }
  return pending;
}

// Reads the crests between the rows of the current column. Ground before row 0 belongs to the path.
void PolarGround::read_crests(const PatchGeometry& geometry, const PatchTerrain& terrain, std::size_t lane) {
  Column& column = *window_;
  const std::size_t rows = column.positions.count;
  float* crest_m = &strip_crest_[lane * pitch_];
  std::fill_n(crest_m, rows, kNoHorizon);
  if (terrain.crests.summits) raise_to_summits(lane);
  if (!terrain.crests.lines || !terrain.window->crests(column.positions.run(),
                                                       {geometry.altitude_m(),
                                                        geometry.earth().curvature(),
                                                        geometry.earth().lift().of_elevation,
                                                        std::span(column.distance_m).first(rows),
                                                        {}},
                                                       std::span(column.crest).first(rows)))
    return;
  column.crest[0] = terrain::kNoTangent;
  const auto plane_m = static_cast<float>(geometry.plane_msl_m());
  for (std::size_t row = 0; row < rows; ++row) {
    const Sight& sight = row_sight_[row];
    const float tangent = column.crest[row];
    const float per_metre = 1.0F / (sight.cosine - tangent * sight.sine);
    const float height_m = (sight.above_m + tangent * sight.chord_m) * per_metre - plane_m;
    if (tangent > terrain::kNoTangent)
      crest_m[row] = std::max(crest_m[row], height_m - sight.bow * height_m * height_m * per_metre);
  }
}

// If the tangent of a row is not below the tangents of the previous and the next row, the parabola through all three
// has its summit near the row. A summit nearer to the aircraft than the row can hide that row. A summit beyond the row
// can hide the next row.
void PolarGround::raise_to_summits(std::size_t lane) {
  const std::size_t rows = window_->positions.count;
  const float* const height_m = &strip_height_[lane * pitch_];
  const float* const gamma = &strip_gamma_[lane * pitch_];
  float* const crest_m = &strip_crest_[lane * pitch_];
  const auto tangent = [&](std::size_t row) {
    return (height_m[row] - row_sight_[row].above_plane_m) / row_sight_[row].distance_m;
  };
  if (rows < 3) return;
  float before = tangent(0), here = tangent(1);
  for (std::size_t row = 1; row + 1 < rows; ++row) {
    const float after = tangent(row + 1);
    // A void repeats its neighbour's height. The height step at the far end of a void is no summit.
    const bool known = gamma[row - 1] > 0.0F && gamma[row] > 0.0F && gamma[row + 1] > 0.0F;
    if (known && here >= before && here >= after && (here > before || here > after)) {
      const float lean = after - before;
      const float summit = here + 0.125F * lean * lean / (here - before + (here - after));
      const std::size_t hidden = lean < 0.0F ? row : row + 1;
      crest_m[hidden] = summit * row_sight_[hidden].distance_m + row_sight_[hidden].above_plane_m;
    }
    before = here;
    here = after;
  }
}

void PolarGround::store_crests(const PolarGrid& grid, int strip, float* crest_m) const {
  float* const points = crest_m + grid.at(strip * kStripColumns, 0);
  for (std::size_t row = 0; row < static_cast<std::size_t>(grid.rows); ++row)
    for (std::size_t lane = 0; lane < std::size_t{kStripColumns}; ++lane)
      points[row * kStripColumns + lane] = strip_crest_[lane * pitch_ + row];
}

// Labels of the current column: its surface materials, or water where the posts around are mostly at 0 m.
void PolarGround::read_labels(std::size_t lane, bool materials) {
  constexpr float kMostlyWater = 0.5F;
  constexpr std::uint32_t kWater = ground_label(radar::kWaterMaterial);
  std::uint32_t* const label = &strip_label_[lane * pitch_];
  for (std::size_t row = 0; row < window_->positions.count; ++row) {
    const auto code = materials ? static_cast<std::uint8_t>(ground_->materials()[row]) : std::uint8_t{0};
    label[row] = code == 0 && window_->water[row] > kMostlyWater ? kWater : ground_label(code);
  }
}

// Stores the labels of the strip. A column between sampled ones has the label of the nearest of them.
void PolarGround::store_labels(const PolarGrid& grid, int strip, int step, std::uint32_t* label) const {
  std::uint32_t* const points = label + grid.at(strip * kStripColumns, 0);
  for (int lane = 0; lane < kStripColumns; ++lane) {
    const std::uint32_t* const column =
        &strip_label_[static_cast<std::size_t>((lane + step / 2) / step * step) * pitch_];
    for (std::size_t row = 0; row < static_cast<std::size_t>(grid.rows); ++row)
      points[row * kStripColumns + static_cast<std::size_t>(lane)] = column[row];
  }
}

// Subtracts the map plane from the heights of the current column. Voids get gamma 0 and the height of the last known
// point before them.
void PolarGround::subtract_plane(const PatchGeometry& geometry, std::size_t lane) {
  const auto plane_m = static_cast<float>(geometry.plane_msl_m());
  const std::size_t rows = window_->positions.count;
  float* height_m = &strip_height_[lane * pitch_];
  float* gamma = &strip_gamma_[lane * pitch_];
  int voids = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    height_m[row] -= plane_m;
    voids += std::isnan(height_m[row]) ? 1 : 0;
  }
  if (voids == 0) return;
  // Voids before the first known point get the height of that point, so they do not hide it.
  const float* const known = std::find_if(height_m, height_m + rows, [](float height) { return !std::isnan(height); });
  float last_m = known < height_m + rows ? *known : 0.0F;
  for (std::size_t row = 0; row < rows; ++row) {
    const bool is_void = std::isnan(height_m[row]);
    if (!is_void) last_m = height_m[row];
    height_m[row] = last_m;
    if (is_void) gamma[row] = 0.0F;
  }
}

// Interpolates heights between the sampled columns. Without materials gamma, too.
void PolarGround::interpolate_columns(std::size_t step, bool materials) {
  const std::size_t rows = window_->positions.count;
  simd::interpolate_columns(rows, step, strip_height_.data(), pitch_);
  if (!materials) simd::interpolate_columns(rows, step, strip_gamma_.data(), pitch_);
}

// Prefetches (loads into the cache) one sixteenth of a strip's output with each column.
void PolarGround::prefetch_strip(const PolarGrid& grid, int column, const GroundArrays& arrays) const {
  const auto part_rows = static_cast<std::size_t>(grid.rows) / std::size_t{kStripColumns} + 1;
  const std::size_t strip = grid.at(column - column % kStripColumns, 0);
  const std::size_t first = part_rows * static_cast<std::size_t>(column % kStripColumns);
  const std::size_t last = std::min(first + part_rows, static_cast<std::size_t>(grid.rows));
  for (std::size_t row = first; row < last; ++row) {
    const SurfacePoint* const points = arrays.surface + strip + row * kStripColumns;
    hwy::Prefetch(points);
    hwy::Prefetch(points + kStripColumns / 2);
  }
}

// Stores the strip: transposes its sixteen columns to the row order of the polar grid.
void PolarGround::store_strip(const PolarGrid& grid, int strip, const GroundArrays& arrays) const {
  simd::interleave_columns(static_cast<std::size_t>(grid.rows), strip_gamma_.data(), strip_height_.data(), pitch_,
                           arrays.surface + grid.at(strip * kStripColumns, 0));
}

}  // namespace yars::model::hrm
