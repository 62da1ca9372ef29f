#include "model/hrm/response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace yars::model::hrm {

namespace {
constexpr int kEqualLobes = 5;           // n-bar: so many sidelobes of one height, falling behind
constexpr double kMainLobeCells = 1.5;   // the first null of -35 dB lies at 1.4 cells
constexpr double kSidelobeCells = 16.0;  // what lies farther out is below any picture's black

// Taylor's coefficients F_m of w(x) = 1 + 2 sum F_m cos(2 pi m x).
std::vector<double> taylor_coefficients(double sidelobe_db) {
  const double a = std::acosh(std::pow(10.0, std::abs(sidelobe_db) / 20.0)) / std::numbers::pi;
  constexpr double n = kEqualLobes;
  const double sigma2 = n * n / (a * a + (n - 0.5) * (n - 0.5));
  std::vector<double> coefficients{1.0};
  for (int m = 1; m < kEqualLobes; ++m) {
    double above = 1.0;
    double below = 1.0;
    for (int i = 1; i < kEqualLobes; ++i) {
      above *= 1.0 - m * m / (sigma2 * (a * a + (i - 0.5) * (i - 0.5)));
      if (i != m) below *= 1.0 - static_cast<double>(m * m) / (i * i);
    }
    coefficients.push_back((m % 2 == 1 ? 0.5 : -0.5) * above / below);
  }
  return coefficients;
}

double sinc(double x) {
  const double y = std::numbers::pi * x;
  return std::abs(y) < 1e-9 ? 1.0 : std::sin(y) / y;
}

double amplitude(const std::vector<double>& coefficients, double x) {
  double sum = coefficients[0] * sinc(x);
  for (std::size_t m = 1; m < coefficients.size(); ++m) {
    const auto shift = static_cast<double>(m);
    sum += coefficients[m] * (sinc(x - shift) + sinc(x + shift));
  }
  return sum / coefficients[0];
}

// Where the power has fallen to a half, in units of 1 / bandwidth.
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

Response::Response(double sidelobe_db, double cells_a_pixel)
    : coefficients_(taylor_coefficients(sidelobe_db)), cells_a_pixel_(cells_a_pixel) {
  stretch_ = 2.0 * half_power_point(coefficients_);
  double sum = 0.0;
  std::vector<double> tail;
  for (int pixel = 0; pixel * cells_a_pixel <= kSidelobeCells; ++pixel) {
    const double value = power(pixel * cells_a_pixel);
    if (pixel == 0 || pixel * cells_a_pixel <= kMainLobeCells) {
      main_lobe_.push_back(static_cast<float>(value));
      sum += pixel == 0 ? value : 2.0 * value;
    } else {
      sidelobes_.push_back(static_cast<float>(value));
    }
  }
  for (float& value : main_lobe_) value = static_cast<float>(static_cast<double>(value) / sum);
  for (float& value : sidelobes_) value = static_cast<float>(static_cast<double>(value) / sum);
}

double Response::power(double cells) const {
  const double a = amplitude(coefficients_, cells * stretch_);
  return a * a;
}

std::vector<float> Response::weights(double pixel, int& first) const {
  const int reach = static_cast<int>(std::ceil(kSidelobeCells / cells_a_pixel_));
  first = static_cast<int>(std::lround(pixel)) - reach;
  std::vector<double> values;
  double sum = 0.0;
  for (int i = first; i <= first + 2 * reach; ++i) {
    values.push_back(power((i - pixel) * cells_a_pixel_));
    sum += values.back();
  }
  std::vector<float> weights;
  for (const double value : values) weights.push_back(static_cast<float>(value / sum));
  return weights;
}

void Response::apply(float floor, MapImage& image) const {
  smooth(image);
  add_sidelobes(floor, image);
}

namespace {
// to[i] = sum of the kernel over from[i - reach .. i + reach]; what lies beyond the edge is black. `from` has `reach`
// zeros before and behind its `count` entries.
void convolve(const std::vector<float>& kernel, const float* from, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = kernel[0] * from[i];
  for (std::size_t k = 1; k < kernel.size(); ++k) {
    const float weight = kernel[k];
    const float* before = from - k;
    const float* behind = from + k;
    for (std::size_t i = 0; i < count; ++i) to[i] += weight * (before[i] + behind[i]);
  }
}
}  // namespace

// Columns by whole rows, so that both passes run along memory.
void Response::smooth(MapImage& image) const {
  if (main_lobe_.size() < 2) return;
  const auto size = static_cast<std::size_t>(image.size);
  const std::size_t reach = main_lobe_.size() - 1;
  std::vector<float> padded(size + 2 * reach, 0.0F);
  for (std::size_t row = 0; row < size; ++row) {
    float* pixels = &image.power[row * size];
    std::copy_n(pixels, size, padded.begin() + static_cast<std::ptrdiff_t>(reach));
    convolve(main_lobe_, padded.data() + reach, size, pixels);
  }
  std::vector<float> across(image.power.size());
  for (std::size_t row = 0; row < size; ++row) {
    float* to = &across[row * size];
    const float* from = &image.power[row * size];
    for (std::size_t i = 0; i < size; ++i) to[i] = main_lobe_[0] * from[i];
    for (std::size_t k = 1; k <= reach; ++k) {
      const float weight = main_lobe_[k];
      for (const bool nearer : {true, false}) {
        if (nearer ? row < k : row + k >= size) continue;
        const float* other = nearer ? from - k * size : from + k * size;
        for (std::size_t i = 0; i < size; ++i) to[i] += weight * other[i];
      }
    }
  }
  image.power.swap(across);
}

void Response::add_sidelobes(float floor, MapImage& image) const {
  if (sidelobes_.empty()) return;
  const float strong = floor / *std::max_element(sidelobes_.begin(), sidelobes_.end());
  const int near = static_cast<int>(main_lobe_.size());
  // Strong points first, all of them: what one adds must not make another strong.
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < image.power.size(); ++i)
    if (image.power[i] > strong) points.push_back(i);
  std::vector<float> levels;
  for (const std::size_t i : points) levels.push_back(image.power[i]);
  const auto size = static_cast<std::size_t>(image.size);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto column = static_cast<int>(points[p] % size);
    const auto row = static_cast<int>(points[p] / size);
    for (std::size_t k = 0; k < sidelobes_.size(); ++k) {
      const int off = near + static_cast<int>(k);
      const float level = levels[p] * sidelobes_[k];
      if (column >= off) image.power[image.at(column - off, row)] += level;
      if (column + off < image.size) image.power[image.at(column + off, row)] += level;
      if (row >= off) image.power[image.at(column, row - off)] += level;
      if (row + off < image.size) image.power[image.at(column, row + off)] += level;
    }
  }
}

}  // namespace yars::model::hrm
