#include "model/hrm/ground_fan.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>

#include "model/hrm/strip_lanes.hpp"
#include "model/reflectivity/land.hpp"

namespace yars::model::hrm {

namespace {
// Spacing [m] of the samples on the way to the window: about that of fine posts; a narrower ridge hides next to
// nothing.
constexpr double kPathSpacing_m = 60.0;
constexpr double kMostPathSamples = 4096.0;
// Of a strip every fifth column looks along the way, the first and the last among them: columns lie a pixel apart where
// the window is and closer before it, and posts many. What lies between is interpolated.
constexpr int kPathColumns = 5;
static_assert((kStripColumns - 1) % kPathColumns == 0);
constexpr float kNoHorizon = -1.0e6F;  // below every ray
// In the window, where posts are many columns apart, every third or fifth column is read, the first and the last of a
// strip among them, as far apart as so much of the posts' spacing; what lies between is interpolated.
constexpr double kPostShare = 0.25;

void join_horizons(float* horizon) {
  for (int lane = 0; lane < kStripColumns; ++lane) {
    const int off = lane % kPathColumns;
    if (off == 0) continue;
    const float first = horizon[lane - off];
    const float second = horizon[lane - off + kPathColumns];
    horizon[lane] = first + static_cast<float>(off) / static_cast<float>(kPathColumns) * (second - first);
  }
}
}  // namespace

GroundFan::Column::Column(std::size_t samples)
    : places(samples),
      distance_m(samples + terrain::kRunSlack),
      elevation_m(distance_m.size()),
      water(distance_m.size()),
      peak_m(distance_m.size()),
      crest(distance_m.size()) {}

GroundFan::GroundFan(const radar::RadarConfiguration& configuration)
    : configuration_(configuration),
      plain_gamma_(static_cast<float>(reflectivity::make_land_return(configuration).gamma[0])) {}

void GroundFan::begin(const PatchGeometry& geometry, const FanGrid& grid) {
  const auto rows = static_cast<std::size_t>(grid.rows);
  if (!window_ || window_->places.count != rows) {
    window_ = std::make_unique<Column>(rows);
    ground_ = std::make_unique<rbm::Ground>(configuration_, rows);
    sin_grazing_.assign(rows + terrain::kRunSlack, 0.0F);
    // No power of two: rows of sixteen columns shall not meet in one place of the cache.
    pitch_ = (rows / terrain::kRunSlack + 1) * terrain::kRunSlack;
    if (pitch_ / terrain::kRunSlack % 2 == 0) pitch_ += terrain::kRunSlack;
    strip_height_.assign(kStripColumns * pitch_ + terrain::kRunSlack, 0.0F);
    strip_gain_.assign(strip_height_.size(), 0.0F);
  }
  for (std::size_t row = 0; row < window_->distance_m.size(); ++row) {
    const double distance_m = grid.distance_m(static_cast<double>(std::min(row, rows - 1)));
    window_->distance_m[row] = static_cast<float>(distance_m);
    const double above_m = geometry.altitude_m() - geometry.plane_msl_m();
    sin_grazing_[row] = static_cast<float>(std::max(0.0, geometry.earth().sight(above_m, distance_m, 0.0).sin_grazing));
  }
  const double path_m = grid.first_distance_m;
  const auto samples = static_cast<std::size_t>(std::clamp(std::ceil(path_m / kPathSpacing_m), 1.0, kMostPathSamples));
  if (!path_ || path_->places.count != samples) path_ = std::make_unique<Column>(samples);
  above_path_m_.resize(path_->distance_m.size());
  for (std::size_t i = 0; i < path_->distance_m.size(); ++i) {
    const double share = (static_cast<double>(std::min(i, samples - 1)) + 0.5) / static_cast<double>(samples);
    path_->distance_m[i] = static_cast<float>(share * path_m);
    above_path_m_[i] = static_cast<float>(geometry.above_plane_m(share * path_m));
  }
  ground_->use_resolution(grid.spacing_m, grid.spacing_m);
}

std::size_t GroundFan::fill(const PatchOrder& order, const PatchGeometry& geometry, const FanGrid& grid,
                            const PatchTerrain& terrain, const Detail* detail, int first, int last,
                            const GroundArrays& arrays) {
  const int step = column_step(grid, *terrain.window, detail);
  std::size_t pending = 0;
  for (int column = first; column < last; ++column) {
    const geo::Bearing azimuth = geometry.up() + geo::Angle::radians(std::atan(grid.tangent(column)));
    const int lane = column % kStripColumns;
    if (lane % kPathColumns == 0) pending += read_path(geometry, grid, azimuth, *terrain.path, arrays.horizon[column]);
    if (lane % step == 0) {
      pending += read_window(order, geometry, azimuth, *terrain.window, detail, static_cast<std::size_t>(lane));
      level(geometry, static_cast<std::size_t>(lane));
    }
    fetch_strip(grid, column, arrays);
    if (lane + 1 < kStripColumns) continue;
    if (step > 1) fill_between(static_cast<std::size_t>(step));
    put_strip(grid, column / kStripColumns, arrays);
    join_horizons(arrays.horizon + column + 1 - kStripColumns);
  }
  return pending;
}

// Not where what covers the ground is a matter of one post or another, and never for who takes each column's word.
int GroundFan::column_step(const FanGrid& grid, const terrain::TerrainView& view, const Detail* detail) const {
  const radar::Fidelity& fidelity = configuration_.fidelity;
  const bool smooth = fidelity.algorithm == radar::Algorithm::standard && !view.has_materials() &&
                      fidelity.interpolation != radar::Interpolation::nearest;
  if (!smooth) return 1;
  double farthest_m = kPostShare * view.post_spacing_m();
  if (detail != nullptr) farthest_m = std::min(farthest_m, detail->texel_m());
  const double width_m = grid.width_m(0.5 * grid.columns, grid.distance_m(grid.rows - 1));
  for (const int step : {5, 3})
    if (step * width_m <= farthest_m) return step;
  return 1;
}

// Into the column's place in the strip; the slack behind it is the next one's, who comes later.
std::size_t GroundFan::read_window(const PatchOrder& order, const PatchGeometry& geometry, geo::Bearing azimuth,
                                   const terrain::TerrainView& view, const Detail* detail, std::size_t lane) {
  Column& column = *window_;
  const std::size_t rows = column.places.count;
  float* height_m = &strip_height_[lane * pitch_];
  float* gain = &strip_gain_[lane * pitch_];
  const geo::Length range = geo::Length::metres(static_cast<double>(column.distance_m[rows - 1]));
  rbm::sample_places(geometry.apex(), azimuth, range, configuration_.fidelity.geodesic_knots, column.distance_m.data(),
                     column.places);
  const terrain::SurfaceRun found{
      {height_m, rows},
      {column.water.data(), rows},
      {},
      view.has_materials() ? std::span(ground_->materials()).first(rows) : std::span<std::int32_t>{}};
  const std::size_t pending = view.surfaces(column.places.run(), configuration_.fidelity.interpolation, found);
  const rbm::Look look{geometry.apex(), order.altitude, azimuth, {}, range, order.sim_time, order.band, order.channel};
  const rbm::Ground::Sample reflects =
      ground_->reflect(look, column.places.run(), column.water.data(), sin_grazing_.data(), view.has_materials());
  if (reflects.land != nullptr)
    std::copy_n(reflects.land, rows, gain);
  else
    std::fill_n(gain, rows, plain_gamma_);
  // The sea's sigma0 is of level water; what is seen square on is less by the sine.
  if (reflects.sea != nullptr)
    for (std::size_t row = 0; row < rows; ++row)
      if (sin_grazing_[row] > 0.0F) gain[row] += reflects.sea[row] / sin_grazing_[row];
  if (detail != nullptr) detail->modulate(column.places.run(), gain);
  return pending;
}

std::size_t GroundFan::read_path(const PatchGeometry& geometry, const FanGrid& grid, geo::Bearing azimuth,
                                 const terrain::TerrainView& view, float& horizon) {
  Column& column = *path_;
  const std::size_t samples = column.places.count;
  rbm::sample_places(geometry.apex(), azimuth, geo::Length::metres(grid.first_distance_m),
                     configuration_.fidelity.geodesic_knots, column.distance_m.data(), column.places);
  const bool peaks = view.has_peaks();
  const terrain::SurfaceRun found{{column.elevation_m.data(), samples},
                                  {column.water.data(), samples},
                                  peaks ? std::span(column.peak_m).first(samples) : std::span<float>{},
                                  {}};
  const std::size_t pending = view.surfaces(column.places.run(), configuration_.fidelity.interpolation, found);
  const std::vector<float>& top_m = peaks ? column.peak_m : column.elevation_m;
  const auto plane_m = static_cast<float>(geometry.plane_msl_m());
  horizon = kNoHorizon;
  for (std::size_t i = 0; i < samples; ++i) {
    const float tangent = (top_m[i] - plane_m - above_path_m_[i]) / column.distance_m[i];
    if (tangent > horizon) horizon = tangent;  // never for a void
  }
  // Lines of posts between the samples.
  const rbm::EffectiveEarth& earth = geometry.earth();
  if (view.crests(column.places.run(),
                  {geometry.altitude_m(), earth.curvature(), std::span(column.distance_m).first(samples)},
                  std::span(column.crest).first(samples)))
    horizon = std::max(
        horizon, *std::max_element(column.crest.begin(), column.crest.begin() + static_cast<std::ptrdiff_t>(samples)));
  return pending;
}

// Heights of the column just read count from the map plane; a void takes over its nearer neighbour's.
void GroundFan::level(const PatchGeometry& geometry, std::size_t lane) {
  const auto plane_m = static_cast<float>(geometry.plane_msl_m());
  const std::size_t rows = window_->places.count;
  float* height_m = &strip_height_[lane * pitch_];
  float* gain = &strip_gain_[lane * pitch_];
  int holes = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    height_m[row] -= plane_m;
    holes += std::isnan(height_m[row]) ? 1 : 0;
  }
  if (holes == 0) return;
  float last_m = 0.0F;
  for (std::size_t row = 0; row < rows; ++row) {
    const bool hole = std::isnan(height_m[row]);
    if (!hole) last_m = height_m[row];
    height_m[row] = last_m;
    if (hole) gain[row] = 0.0F;
  }
}

void GroundFan::fill_between(std::size_t step) {
  const std::size_t rows = window_->places.count;
  lanes::fill_between(rows, step, strip_height_.data(), pitch_);
  lanes::fill_between(rows, step, strip_gain_.data(), pitch_);
}

// Before a strip is put down its place is fetched, a sixteenth with every column that is read for it.
void GroundFan::fetch_strip(const FanGrid& grid, int column, const GroundArrays& arrays) const {
  const auto share = static_cast<std::size_t>(grid.rows) / std::size_t{kStripColumns} + 1;
  const std::size_t strip = grid.at(column - column % kStripColumns, 0);
  const std::size_t first = share * static_cast<std::size_t>(column % kStripColumns);
  const std::size_t last = std::min(first + share, static_cast<std::size_t>(grid.rows));
  for (std::size_t row = first; row < last; ++row) {
    const SurfacePoint* const points = arrays.surface + strip + row * kStripColumns;
    hwy::Prefetch(points);
    hwy::Prefetch(points + kStripColumns / 2);
  }
}

// A column's numbers lie one behind the other when read, and sixteen columns' side by side on the fan.
void GroundFan::put_strip(const FanGrid& grid, int strip, const GroundArrays& arrays) const {
  lanes::put_side_by_side(static_cast<std::size_t>(grid.rows), strip_gain_.data(), strip_height_.data(), pitch_,
                          arrays.surface + grid.at(strip * kStripColumns, 0));
}

}  // namespace yars::model::hrm
