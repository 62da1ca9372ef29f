#include "model/hrm/response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "model/hrm/response_lanes.hpp"

namespace yars::model::hrm {

namespace {
constexpr std::size_t kLanes = 16;       // counts of the loops are multiples of it
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

// Rows and columns of black about a copy of the image, so that no sum looks over an edge.
void Response::make_room(const MapImage& image) {
  const auto size = static_cast<std::size_t>(image.size);
  const std::size_t taps = main_lobe_.size() + sidelobes_.size();
  margin_ = (taps + kLanes - 1) / kLanes * kLanes;
  columns_ = (size + kLanes - 1) / kLanes * kLanes;
  pitch_ = columns_ + 2 * margin_;
  const std::size_t room = pitch_ * (size + 2 * margin_);
  if (source_.size() == room) return;
  source_.assign(room, 0.0F);
  across_.assign(room, 0.0F);
  row_.assign(columns_, 0.0F);
}

void Response::apply(float floor, MapImage& image) {
  make_room(image);
  smooth(image);
  add_sidelobes(floor, image);
}

void Response::smooth(MapImage& image) {
  if (main_lobe_.size() < 2) return;
  const auto size = static_cast<std::size_t>(image.size);
  const std::span<const float> lobe = std::span<const float>(main_lobe_).subspan(1);
  const auto pitch = static_cast<std::ptrdiff_t>(pitch_);
  for (std::size_t row = 0; row < size; ++row) {
    float* from = &source_[padded(row)];
    std::copy_n(&image.power[row * size], size, from);
    std::fill(from + size, from + columns_, 0.0F);
    lanes::scale(columns_, from, main_lobe_[0], &across_[padded(row)]);
    lanes::add_neighbours(columns_, from, 1, 1, lobe, &across_[padded(row)]);
    std::fill(&across_[padded(row)] + size, &across_[padded(row)] + columns_, 0.0F);
  }
  for (std::size_t row = 0; row < size; ++row) {
    const float* from = &across_[padded(row)];
    lanes::scale(columns_, from, main_lobe_[0], row_.data());
    lanes::add_neighbours(columns_, from, pitch, 1, lobe, row_.data());
    std::copy_n(row_.data(), size, &image.power[row * size]);
  }
}

// Strong points first, all of them: what one adds must not make another strong.
void Response::add_sidelobes(float floor, MapImage& image) {
  if (sidelobes_.empty()) return;
  const auto size = static_cast<std::size_t>(image.size);
  const float strong = floor / *std::max_element(sidelobes_.begin(), sidelobes_.end());
  const auto first = static_cast<std::ptrdiff_t>(main_lobe_.size());
  bool any = false;
  std::fill(row_.begin(), row_.end(), 0.0F);
  for (std::size_t row = 0; row < size; ++row) {
    std::copy_n(&image.power[row * size], size, row_.data());
    any = lanes::keep_above(columns_, row_.data(), strong, &source_[padded(row)]) || any;
  }
  if (!any) return;
  for (std::size_t row = 0; row < size; ++row) {
    const float* from = &source_[padded(row)];
    std::copy_n(&image.power[row * size], size, row_.data());
    lanes::add_neighbours(columns_, from, 1, first, sidelobes_, row_.data());
    lanes::add_neighbours(columns_, from, static_cast<std::ptrdiff_t>(pitch_), first, sidelobes_, row_.data());
    std::copy_n(row_.data(), size, &image.power[row * size]);
  }
}

}  // namespace yars::model::hrm
