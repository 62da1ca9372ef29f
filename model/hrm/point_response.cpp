#include "model/hrm/point_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

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

// Sets the size of a slab and of the buffers. Zero margins about the rows make bounds checks of the sums unnecessary.
void Response::resize_buffers(const parallel::Executor& executor, const MapImage& image, std::size_t slab_bytes) {
  const auto size = static_cast<std::size_t>(image.size);
  const std::size_t taps = main_lobe_.size() + sidelobes_.size();
  margin_ = along_radius_ * simd::kBlock;
  columns_ = (size + simd::kBlock - 1) / simd::kBlock * simd::kBlock;
  pitch_ = columns_ + 2 * margin_;
  const std::size_t runs = (size + kRowsPerTask - 1) / kRowsPerTask;
  const std::size_t runs_of_slab =
      std::clamp(slab_bytes / (pitch_ * sizeof(float)) / kRowsPerTask, std::size_t{1}, runs);
  slab_rows_ = runs_of_slab * kRowsPerTask;
  // The sidelobes of a run end `taps` rows beyond it, before and behind.
  strong_.resize(runs_of_slab + 2 * (taps / kRowsPerTask + 2));
  const std::size_t padded_size = pitch_ * (slab_rows_ + 2 * main_radius());
  if (across_.size() == padded_size && buffers_.size() == executor.threads) return;
  across_.assign(padded_size, 0.0F);
  buffers_.resize(executor.threads);
  for (WorkerBuffers& buffers : buffers_) {
    buffers.source.assign(pitch_, 0.0F);
    buffers.row.assign(columns_, 0.0F);
    buffers.added.assign(kRowsPerTask * pitch_, 0.0F);
  }
}

// Sidelobes are added behind the slab by as many rows as they reach, because they need the strong blocks of all rows
// that they reach. They are not added to rows of which across_ is still to be computed.
void Response::apply(float floor, const parallel::Executor& executor, MapImage& image, std::size_t slab_bytes) {
  resize_buffers(executor, image, slab_bytes);
  const float limit = sidelobes_.empty() ? 0.0F : floor / *std::max_element(sidelobes_.begin(), sidelobes_.end());
  const auto taps = static_cast<int>(main_lobe_.size() + sidelobes_.size());
  int added = 0;  // rows whose sidelobes are added
  for (int first = 0; first < image.size; first += static_cast<int>(slab_rows_)) {
    const int last = std::min(first + static_cast<int>(slab_rows_), image.size);
    if (main_lobe_.size() > 1) begin_slab(first, last, executor, image);
    parallel::parallel_for(executor, last - first, kRowsPerTask, [&](int begin, int end, std::size_t thread) {
      if (main_lobe_.size() > 1) smooth_down(first + begin, first + end, buffers_[thread], image);
      if (!sidelobes_.empty()) find_strong(limit, first + begin, first + end, buffers_[thread], image);
    });
    if (sidelobes_.empty()) continue;
    const int known = last == image.size ? last : std::max((last - taps) / kRowsPerTask * kRowsPerTask, added);
    parallel::parallel_for(executor, known - added, kRowsPerTask, [&](int begin, int end, std::size_t thread) {
      for (int row = added + begin; row < added + end; row += kRowsPerTask)
        add_sidelobes(row, std::min(row + kRowsPerTask, added + end), buffers_[thread], image);
    });
    added = known;
  }
}

// Fills across_ for the rows [first, last) and main_radius() rows before and behind. The rows before have been
// overwritten in the image, so they are kept from the slab before.
void Response::begin_slab(int first, int last, const parallel::Executor& executor, const MapImage& image) {
  const auto radius = static_cast<int>(main_radius());
  const std::size_t rows = 2 * main_radius() * pitch_;
  if (first == 0)
    std::fill_n(across_.begin(), main_radius() * pitch_, 0.0F);
  else
    std::copy_n(across_.begin() + static_cast<std::ptrdiff_t>(slab_rows_ * pitch_), rows, across_.begin());
  slab_first_ = static_cast<std::size_t>(first);
  const int begin = first == 0 ? 0 : std::min(first + radius, image.size);
  const int end = std::min(last + radius, image.size);
  parallel::parallel_for(executor, end - begin, kRowsPerTask, [&](int from, int to, std::size_t thread) {
    smooth_along(begin + from, begin + to, buffers_[thread], image);
  });
  for (int row = end; row < last + radius; ++row)
    std::fill_n(&across_[across_at(static_cast<std::size_t>(row))] - margin_, pitch_, 0.0F);
}

void Response::smooth_along(int first, int last, WorkerBuffers& buffers, const MapImage& image) {
  const auto size = static_cast<std::size_t>(image.size);
  const std::size_t radius = main_radius();
  float* const padded = &buffers.source[margin_];
  // Blocks at the ends of a row reach beyond it, and are computed from a padded copy.
  const std::size_t head = std::min((radius + simd::kBlock - 1) / simd::kBlock * simd::kBlock, columns_);
  const std::size_t tail = std::max(size > radius ? (size - radius) / simd::kBlock * simd::kBlock : 0, head);
  const std::size_t head_end = std::min(head + radius, size);
  const std::size_t tail_begin = std::min(tail - std::min(radius, tail), size);
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    const float* const from = &image.power[row * size];
    float* const to = &across_[across_at(row)];
    std::copy_n(from, head_end, padded);
    simd::smooth(head, padded, 1, main_lobe_, to);
    simd::smooth(tail - head, from + head, 1, main_lobe_, to + head);
    std::copy(from + tail_begin, from + size, padded + tail_begin);
    simd::smooth(columns_ - tail, padded + tail, 1, main_lobe_, to + tail);
  }
}

void Response::smooth_down(int first, int last, WorkerBuffers& buffers, MapImage& image) const {
  const auto size = static_cast<std::size_t>(image.size);
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    // Writes to the image directly if rows are whole blocks.
    float* to = columns_ == size ? &image.power[row * size] : buffers.row.data();
    simd::smooth(columns_, &across_[across_at(row)], static_cast<std::ptrdiff_t>(pitch_), main_lobe_, to);
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
    std::vector<StrongBlock>& strong = run(row / kRowsPerTask);
    if (row % kRowsPerTask == 0) strong.clear();
    StrongBlock found{row, 0, {}};
    for (found.column = 0; found.column < columns_; found.column += simd::kBlock)
      if (simd::keep_above(from + found.column, limit, found.power.data())) strong.push_back(found);
  }
}

// Adds the sidelobes of a block to the rows [first, last), which are the rows of `added`.
void Response::spread(const StrongBlock& strong, std::size_t first, std::size_t last, float* added) const {
  const std::size_t lobe = main_lobe_.size();
  const std::size_t taps = lobe + sidelobes_.size();
  const std::span<const float> weights(sidelobes_);
  const auto at = [&](std::size_t row) { return added + (row - first) * pitch_ + margin_ + strong.column; };
  const auto pitch = static_cast<std::ptrdiff_t>(pitch_);
  if (strong.row >= first && strong.row < last)
    simd::spread_along(strong.power.data(), along_radius_, &along_[along_middle_], at(strong.row));
  // The sidelobes above the block lie in the rows strong.row - taps + 1 to strong.row - lobe. The sidelobes below
  // are mirrored.
  const std::size_t nearest = strong.row >= last ? std::max(lobe, strong.row - last + 1) : lobe;
  const std::size_t farthest = strong.row >= first ? std::min(taps, strong.row - first + 1) : 0;
  if (nearest < farthest)
    simd::spread(strong.power.data(), -pitch, weights.subspan(nearest - lobe, farthest - nearest),
                 at(strong.row - nearest));
  const std::size_t next = strong.row < first ? std::max(lobe, first - strong.row) : lobe;
  const std::size_t end = strong.row < last ? std::min(taps, last - strong.row) : 0;
  if (next < end)
    simd::spread(strong.power.data(), pitch, weights.subspan(next - lobe, end - next), at(strong.row + next));
}

// Adds the sidelobes of at most kRowsPerTask rows. All strong pixels that reach these rows are found before, so that a
// sidelobe cannot make a pixel strong. Strong pixels are few, so each strong pixel adds to its neighbours (scatter); no
// pixel sums over its neighbours (gather).
void Response::add_sidelobes(int first, int last, WorkerBuffers& buffers, MapImage& image) const {
  const auto size = static_cast<std::size_t>(image.size);
  const auto begin = static_cast<std::size_t>(first);
  const auto end = static_cast<std::size_t>(last);
  const std::size_t radius = main_lobe_.size() + sidelobes_.size();
  const std::size_t first_run = (begin > radius ? begin - radius : 0) / kRowsPerTask;
  const std::size_t last_run = (std::min(end + radius, size) - 1) / kRowsPerTask;
  bool any = false;
  for (std::size_t number = first_run; number <= last_run; ++number) any = any || !run(number).empty();
  if (!any) return;
  std::fill(buffers.added.begin(), buffers.added.end(), 0.0F);
  for (std::size_t number = first_run; number <= last_run; ++number)
    for (const StrongBlock& strong : run(number)) spread(strong, begin, end, buffers.added.data());
  for (std::size_t row = begin; row < end; ++row)
    for (std::size_t i = 0; i < size; ++i)
      image.power[row * size + i] += buffers.added[(row - begin) * pitch_ + margin_ + i];
}

}  // namespace yars::model::hrm
