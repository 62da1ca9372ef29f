#include "model/hrm/point_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "lib/radar/fidelity.hpp"
#include "lib/radar/mapping.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

namespace {
constexpr int kEqualLobes = 5;           // n-bar: number of nearly equal sidelobes (Taylor)
constexpr double kMainLobeCells = 1.5;   // [cells] half width of the main lobe; at -35 dB the first null is at 1.4
constexpr int kRowsPerTask = 32;         // rows of the image per task of a thread
constexpr double kSidelobeCells = 16.0;  // [cells] radius of the response; farther sidelobes are invisible

// Taylor's coefficients F_m of the weighting w(x) = 1 + 2 sum F_m cos(2 pi m x), x in [-1/2, 1/2] across the aperture.
std::vector<double> taylor_coefficients(double sidelobe_db) {
  const double a = std::acosh(std::pow(10.0, std::abs(sidelobe_db) / 20.0)) / std::numbers::pi;
  constexpr double n = kEqualLobes;
  const double sigma2 = n * n / (a * a + (n - 0.5) * (n - 0.5));
  std::vector<double> coefficients{1.0};
  for (int m = 1; m < kEqualLobes; ++m) {
    double numerator = 1.0;
    double denominator = 1.0;
    for (int i = 1; i < kEqualLobes; ++i) {
      numerator *= 1.0 - m * m / (sigma2 * (a * a + (i - 0.5) * (i - 0.5)));
      if (i != m) denominator *= 1.0 - static_cast<double>(m * m) / (i * i);
    }
    coefficients.push_back((m % 2 == 1 ? 0.5 : -0.5) * numerator / denominator);
  }
  return coefficients;
}

double sinc(double x) {
  const double y = std::numbers::pi * x;
  return std::abs(y) < 1e-9 ? 1.0 : std::sin(y) / y;
}

// Amplitude of the response at the delay x / bandwidth from the peak; 1 at the peak.
double amplitude(const std::vector<double>& coefficients, double x) {
  double sum = coefficients[0] * sinc(x);
  for (std::size_t m = 1; m < coefficients.size(); ++m) {
    const auto shift = static_cast<double>(m);
    sum += coefficients[m] * (sinc(x - shift) + sinc(x + shift));
  }
  return sum / coefficients[0];
}

// Delay from the peak at which the power is one half, in units of 1 / bandwidth.
double half_power_point(const std::vector<double>& coefficients) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double a = amplitude(coefficients, middle);
    (a * a > 0.5 ? low : high) = middle;
  }
  return low;
}
}  // namespace

Response::Response(double sidelobe_db, double cells_per_pixel)
    : coefficients_(taylor_coefficients(sidelobe_db)), cells_per_pixel_(cells_per_pixel) {
  stretch_ = 2.0 * half_power_point(coefficients_);
  double sum = 0.0;
  std::vector<double> tail;
  for (int pixel = 0; pixel * cells_per_pixel <= kSidelobeCells; ++pixel) {
    const double value = power(pixel * cells_per_pixel);
    if (pixel == 0 || pixel * cells_per_pixel <= kMainLobeCells) {
      main_lobe_.push_back(static_cast<float>(value));
      sum += pixel == 0 ? value : 2.0 * value;
    } else {
      sidelobes_.push_back(static_cast<float>(value));
    }
  }
  for (float& value : main_lobe_) value = static_cast<float>(static_cast<double>(value) / sum);
  for (float& value : sidelobes_) value = static_cast<float>(static_cast<double>(value) / sum);
  mirror_sidelobes();
}

void Response::mirror_sidelobes() {
  const std::size_t taps = main_lobe_.size() + sidelobes_.size();
  along_radius_ = (taps + simd::kBlock - 1) / simd::kBlock;
  along_middle_ = (along_radius_ + 1) * simd::kBlock;
  along_.assign(2 * along_middle_ + simd::kBlock, 0.0F);
  for (std::size_t i = 0; i < sidelobes_.size(); ++i) {
    const std::size_t off = main_lobe_.size() + i;
    along_[along_middle_ - off] = along_[along_middle_ + off] = sidelobes_[i];
  }
}

double Response::power(double cells) const {
  const double a = amplitude(coefficients_, cells * stretch_);
  return a * a;
}

std::vector<float> Response::weights(double pixel, int& first) const {
  const int radius = static_cast<int>(std::ceil(kSidelobeCells / cells_per_pixel_));
  const int last = 2 * radius;
  first = static_cast<int>(std::lround(pixel)) - radius;
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(last) + 1);
  double sum = 0.0;
  for (int i = first; i <= first + last; ++i) {
    values.push_back(power((i - pixel) * cells_per_pixel_));
    sum += values.back();
  }
  std::vector<float> weights;
  weights.reserve(values.size());
  for (const double value : values) weights.push_back(static_cast<float>(value / sum));
  return weights;
}

// Resizes the padded buffers. Zero margins about the image make bounds checks of the sums unnecessary.
void Response::resize_buffers(const parallel::Executor& executor, const MapImage& image) {
  const auto size = static_cast<std::size_t>(image.size);
  margin_ = along_radius_ * simd::kBlock;
  columns_ = (size + simd::kBlock - 1) / simd::kBlock * simd::kBlock;
  pitch_ = columns_ + 2 * margin_;
  const std::size_t padded_size = pitch_ * (size + 2 * margin_);
  if (across_.size() == padded_size && buffers_.size() == executor.threads) return;
  across_.assign(padded_size, 0.0F);
  added_.assign(padded_size, 0.0F);
  buffers_.resize(executor.threads);
  for (WorkerBuffers& buffers : buffers_) {
    buffers.source.assign(pitch_, 0.0F);
    buffers.row.assign(columns_, 0.0F);
  }
}

void Response::apply(float floor, const parallel::Executor& executor, MapImage& image) {
  resize_buffers(executor, image);
  if (main_lobe_.size() > 1)
    parallel::parallel_for(executor, image.size, kRowsPerTask, [&](int first, int last, std::size_t thread) {
      smooth_along(first, last, buffers_[thread], image);
    });
  const float limit = sidelobes_.empty() ? 0.0F : floor / *std::max_element(sidelobes_.begin(), sidelobes_.end());
  strong_.resize(static_cast<std::size_t>((image.size + kRowsPerTask - 1) / kRowsPerTask));
  parallel::parallel_for(executor, image.size, kRowsPerTask, [&](int first, int last, std::size_t thread) {
    if (main_lobe_.size() > 1) smooth_down(first, last, buffers_[thread], image);
    if (!sidelobes_.empty()) find_strong(limit, first, last, buffers_[thread], image);
  });
  if (sidelobes_.empty()) return;
  if (std::all_of(strong_.begin(), strong_.end(), [](const std::vector<StrongBlock>& run) { return run.empty(); }))
    return;
  parallel::parallel_for(executor, image.size, kRowsPerTask,
                         [&](int first, int last, std::size_t) { add_sidelobes(first, last, image); });
}

void Response::smooth_along(int first, int last, WorkerBuffers& buffers, const MapImage& image) {
  const auto size = static_cast<std::size_t>(image.size);
  float* from = &buffers.source[margin_];
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    std::copy_n(&image.power[row * size], size, from);
    simd::smooth(columns_, from, 1, main_lobe_, &across_[padded(row)]);
  }
}

void Response::smooth_down(int first, int last, WorkerBuffers& buffers, MapImage& image) const {
  const auto size = static_cast<std::size_t>(image.size);
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    // Writes to the image directly if rows are whole blocks.
    float* to = columns_ == size ? &image.power[row * size] : buffers.row.data();
    simd::smooth(columns_, &across_[padded(row)], static_cast<std::ptrdiff_t>(pitch_), main_lobe_, to);
    if (columns_ != size) std::copy_n(to, size, &image.power[row * size]);
  }
}

void Response::find_strong(float limit, int first, int last, WorkerBuffers& buffers, const MapImage& image) {
  const auto size = static_cast<std::size_t>(image.size);
  std::fill(buffers.row.begin(), buffers.row.end(), 0.0F);
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    const float* from = &image.power[row * size];
    if (columns_ != size) {
      std::copy_n(from, size, buffers.row.data());
      from = buffers.row.data();
    }
    std::vector<StrongBlock>& strong = strong_[row / kRowsPerTask];
    if (row % kRowsPerTask == 0) strong.clear();
    StrongBlock found{row, 0, {}};
    for (found.column = 0; found.column < columns_; found.column += simd::kBlock)
      if (simd::keep_above(from + found.column, limit, found.power.data())) strong.push_back(found);
  }
}

// Adds the sidelobes of a block to the rows [first, last).
void Response::spread(const StrongBlock& strong, std::size_t first, std::size_t last) {
  const std::size_t lobe = main_lobe_.size();
  const std::size_t taps = lobe + sidelobes_.size();
  const std::span<const float> weights(sidelobes_);
  float* at = &added_[padded(strong.row) + strong.column];
  const auto pitch = static_cast<std::ptrdiff_t>(pitch_);
  if (strong.row >= first && strong.row < last)
    simd::spread_along(strong.power.data(), along_radius_, &along_[along_middle_], at);
  // The sidelobes above the block lie in the rows strong.row - taps + 1 to strong.row - lobe. The sidelobes below
  // are mirrored.
  const std::size_t nearest = strong.row >= last ? std::max(lobe, strong.row - last + 1) : lobe;
  const std::size_t farthest = strong.row >= first ? std::min(taps, strong.row - first + 1) : 0;
  if (nearest < farthest)
    simd::spread(strong.power.data(), -pitch, weights.subspan(nearest - lobe, farthest - nearest),
                 at - static_cast<std::ptrdiff_t>(nearest) * pitch);
  const std::size_t next = strong.row < first ? std::max(lobe, first - strong.row) : lobe;
  const std::size_t end = strong.row < last ? std::min(taps, last - strong.row) : 0;
  if (next < end)
    simd::spread(strong.power.data(), pitch, weights.subspan(next - lobe, end - next),
                 at + static_cast<std::ptrdiff_t>(next) * pitch);
}

// All strong pixels are found before sidelobes are added, so that a sidelobe cannot make a pixel strong. Strong pixels
// are few, so each strong pixel adds to its neighbours (scatter); no pixel sums over its neighbours (gather).
void Response::add_sidelobes(int first, int last, MapImage& image) {
  const auto size = static_cast<std::size_t>(image.size);
  const auto begin = static_cast<std::size_t>(first);
  const auto end = static_cast<std::size_t>(last);
  for (std::size_t row = begin; row < end; ++row) std::fill_n(&added_[padded(row)] - margin_, pitch_, 0.0F);
  const std::size_t radius = main_lobe_.size() + sidelobes_.size();
  const std::size_t first_run = (begin > radius ? begin - radius : 0) / kRowsPerTask;
  const std::size_t last_run = std::min((end + radius) / kRowsPerTask, strong_.size() - 1);
  for (std::size_t run = first_run; run <= last_run; ++run)
    for (const StrongBlock& strong : strong_[run]) spread(strong, begin, end);
  for (std::size_t row = begin; row < end; ++row)
    for (std::size_t i = 0; i < size; ++i) image.power[row * size + i] += added_[padded(row) + i];
}

namespace {
constexpr double kMinDoppler_mps = 1.0;  // [m/s] lower bound of V |sin(squint)|, which is a divisor

// Adds the response of a point at a fractional position [pixels].
void splat(const Response& response, double column, double row, double power, MapImage& image) {
  int first_column = 0;
  int first_row = 0;
  const std::vector<float> across = response.weights(column, first_column);
  const std::vector<float> down = response.weights(row, first_row);
  for (std::size_t j = 0; j < down.size(); ++j) {
    const int y = first_row + static_cast<int>(j);
    if (y < 0 || y >= image.size) continue;
    for (std::size_t i = 0; i < across.size(); ++i) {
      const int x = first_column + static_cast<int>(i);
      if (x < 0 || x >= image.size) continue;
      image.power[image.at(x, y)] += static_cast<float>(power) * across[i] * down[j];
    }
  }
}
}  // namespace

MapMovers::MapMovers(const physics::RadarParameters& parameters)
    : gas_(parameters), points_(physics::configured_points(parameters)) {}

MapMovers::Trace MapMovers::trace_of(const physics::MovingPoint& mover, const PatchOrder& order,
                                     const PatchGeometry& geometry, geo::Duration formation, double height_m) const {
  const double time_s = formation.seconds();
  const MapPoint start = geometry.point_of(mover.position(order.sim_time));
  const MapPoint end = geometry.point_of(mover.position(order.sim_time + formation));
  const MapPoint middle{0.5 * (start.right_m + end.right_m), 0.5 * (start.up_m + end.up_m)};
  const double ahead_m = middle.up_m + geometry.distance_m();
  const double distance_m = std::hypot(middle.right_m, ahead_m);
  // Unit vector along the line of sight, then radial and cross-range speeds of the target.
  const double out_right = middle.right_m / distance_m;
  const double out_up = ahead_m / distance_m;
  const double speed_right = time_s > 0.0 ? (end.right_m - start.right_m) / time_s : 0.0;
  const double speed_up = time_s > 0.0 ? (end.up_m - start.up_m) / time_s : 0.0;
  const double receding_mps = speed_right * out_right + speed_up * out_up;
  const double crossing_mps = speed_right * out_up - speed_up * out_right;

  const double squint_rad = geometry.squint(order.ground_track).radians() + std::atan2(middle.right_m, ahead_m);
  const double doppler_mps = order.ground_speed.metres_per_second() * std::sin(squint_rad);
  const double clamped_doppler_mps = std::copysign(std::max(std::abs(doppler_mps), kMinDoppler_mps), doppler_mps);
  // With positive squint the map is right of the track, and the aircraft flies to the left on the map. A receding
  // target is shifted aft, to the right.
  const double shift_m = receding_mps / clamped_doppler_mps * distance_m;
  const double layover_m = laid_over_m(distance_m, height_m, geometry.above_level_m(distance_m)) - distance_m;
  const MapPoint shown{middle.right_m + out_right * layover_m + out_up * shift_m,
                       middle.up_m + out_up * layover_m - out_right * shift_m};
  // Radial motion smears in range (range walk). Cross-range motion smears in azimuth by twice the distance moved.
  const double walk_m = receding_mps * time_s;
  const double blur_m = 2.0 * std::abs(crossing_mps) * time_s;
  const MapPoint half{0.5 * (out_right * walk_m + out_up * blur_m), 0.5 * (out_up * walk_m - out_right * blur_m)};
  return {{shown.right_m - half.right_m, shown.up_m - half.up_m},
          {shown.right_m + half.right_m, shown.up_m + half.up_m}};
}

bool MapMovers::hidden(const PatchGeometry& geometry, const Horizons& horizons, MapPoint point, double height_m) const {
  const PolarGrid& grid = *horizons.grid;
  const double ahead_m = point.up_m + geometry.distance_m();
  if (!(ahead_m > 0.0)) return false;
  const double distance_m = std::hypot(point.right_m, ahead_m);
  const int column = static_cast<int>(std::lround((point.right_m / ahead_m - grid.first_tangent) / grid.tangent_step));
  const int row = static_cast<int>(std::floor((distance_m - grid.first_distance_m) / grid.spacing_m));
  if (column < 0 || column >= grid.columns || row < 0) return false;
  const double tangent = (height_m - geometry.above_plane_m(distance_m)) / distance_m;
  double horizon = static_cast<double>(horizons.horizon[column]);
  for (int i = 0; i < std::min(row, grid.rows); ++i) {
    const double row_distance_m = grid.distance_m(i);
    const std::size_t at = grid.at(column, i);
    float top_m = horizons.surface[at].height_m;
    if (horizons.crest_m != nullptr) top_m = std::max(top_m, horizons.crest_m[at]);
    const double raised = (static_cast<double>(top_m) - geometry.above_plane_m(row_distance_m)) / row_distance_m;
    horizon = std::max(horizon, raised);
  }
  return tangent < horizon;
}

void MapMovers::draw(const PatchOrder& order, const PatchGeometry& geometry, geo::Duration formation,
                     const physics::Environment& environment, const Horizons& horizons, const Response& response,
                     MapImage& image) const {
  for (const std::span<const physics::MovingPoint> points : {std::span(points_), environment.traffic})
    for (const physics::MovingPoint& mover : points)
      draw_point(mover, order, geometry, formation, environment.terrain, horizons, response, image);
}

void MapMovers::draw_point(const physics::MovingPoint& mover, const PatchOrder& order, const PatchGeometry& geometry,
                           geo::Duration formation, const terrain::TerrainView& terrain, const Horizons& horizons,
                           const Response& response, MapImage& image) const {
  const double pixel_m = geometry.window_m() / image.size;
  const geo::GeoPoint position = mover.position(order.sim_time);
  const MapPoint point = geometry.point_of(position);
  // Displacement can move a point into the picture from about one window away. Points more than two windows from the
  // centre are skipped.
  if (std::hypot(point.right_m, point.up_m) > 2.0 * geometry.window_m()) return;
  const double ground_m = terrain.elevation_m(position);
  if (std::isnan(ground_m)) return;
  const double height_m = ground_m + mover.height_m - geometry.plane_msl_m();
  if (hidden(geometry, horizons, point, height_m)) return;
  const Trace trace = trace_of(mover, order, geometry, formation, height_m);
  const double length_m = std::hypot(trace.to.right_m - trace.from.right_m, trace.to.up_m - trace.from.up_m);
  const int steps = 1 + static_cast<int>(std::min(std::ceil(length_m / pixel_m), 4.0 * image.size));
  const double distance_m = std::hypot(point.right_m, point.up_m + geometry.distance_m());
  const double loss = gas_.two_way_transmission(geometry.earth(), geometry.altitude_m(), distance_m, ground_m);
  const double power = loss * mover.cross_section_m2 / (unit_return_m2(geometry, image.size) * steps);
  for (int step = 0; step < steps; ++step) {
    const double fraction = (step + 0.5) / steps;
    const double right_m = trace.from.right_m + fraction * (trace.to.right_m - trace.from.right_m);
    const double up_m = trace.from.up_m + fraction * (trace.to.up_m - trace.from.up_m);
    splat(response, right_m / pixel_m + 0.5 * image.size - 0.5, 0.5 * image.size - 0.5 - up_m / pixel_m, power, image);
  }
}

PowerPicture::PowerPicture(const physics::RadarParameters& parameters)
    : high_resolution_(parameters.high_resolution),
      seed_(parameters.seed),
      with_speckle_(parameters.fidelity.noise),
      with_response_(parameters.fidelity.map_response),
      movers_(parameters),
      response_(parameters.high_resolution.sidelobe_db,
                static_cast<double>(radar::kMapCells) / std::max(parameters.fidelity.map_size, 1)) {}

double PowerPicture::thermal_noise(const PatchInputs& inputs, const PatchData& data) const {
  return noise_gamma(high_resolution_, geo::Length::metres(data.geometry->slant_range_m()), inputs.order.window);
}

void PowerPicture::add_response_and_movers(const PatchInputs& inputs, PatchData& data) {
  // Power below the greater of thermal noise and black level is invisible.
  const radar::HighResolutionConfiguration& hrm = high_resolution_;
  const double black = physics::ratio(hrm.brightest_gamma_db - hrm.dynamic_range_db);
  const double floor = std::max(thermal_noise(inputs, data), black);
  if (with_response_) response_.apply(static_cast<float>(floor), inputs.executor, data.image);
  movers_.draw(inputs.order, *data.geometry, data.formation,
               {*inputs.environment.window, nullptr, true, inputs.environment.traffic},
               {&data.grid, data.surface.data(), data.crests_m(), data.horizon.data()}, response_, data.image);
}

void PowerPicture::draw_video(const PatchInputs& inputs, PatchData& data) const {
  const MapNoise noise{thermal_noise(inputs, data), inputs.order.looks, inputs.order.map, seed_, with_speckle_};
  data.picture.resize(data.image.power.size());
  constexpr int kRowsPerTask = 128;  // each task draws two rows of speckle cells again, so smaller tasks cost more time
  parallel::parallel_for(inputs.executor, data.image.size, kRowsPerTask, [&](int first, int last, std::size_t) {
    form_video(high_resolution_, data.image, noise, first, last, data.picture);
  });
}

}  // namespace yars::model::hrm
