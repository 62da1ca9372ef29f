// Row of the texture of the ground in patch maps: ground has no period.
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "model/hrm/ground_detail.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

constexpr std::size_t kSide = 512;    // positions along an edge of the map
constexpr std::size_t kPlane = 1024;  // with zeros beyond the map, so that lags do not wrap
constexpr double kWindow_m = 20.0 * 1852.0;
constexpr double kPixel_m = kWindow_m / static_cast<double>(kSide);

using Complex = std::complex<double>;

// Fourier transform of kPlane numbers `stride` apart, in place.
void transform(Complex* data, std::size_t stride) {
  for (std::size_t i = 1, j = 0; i < kPlane; ++i) {
    std::size_t bit = kPlane >> 1U;
    for (; (j & bit) != 0; bit >>= 1U) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(data[i * stride], data[j * stride]);
  }
  for (std::size_t length = 2; length <= kPlane; length *= 2) {
    const Complex turn = std::polar(1.0, -2.0 * std::numbers::pi / static_cast<double>(length));
    for (std::size_t first = 0; first < kPlane; first += length) {
      Complex factor = 1.0;
      for (std::size_t k = first; k < first + length / 2; ++k, factor *= turn) {
        Complex &even = data[k * stride], &odd = data[(k + length / 2) * stride];
        const Complex turned = odd * factor;
        odd = even - turned;
        even += turned;
      }
    }
  }
}

std::vector<Complex> transformed(std::vector<Complex> plane) {
  for (std::size_t row = 0; row < kPlane; ++row) transform(&plane[row * kPlane], 1);
  for (std::size_t column = 0; column < kPlane; ++column) transform(&plane[column], kPlane);
  return plane;
}

// Sum over all pairs of positions of the map with each lag, less the mean.
std::vector<double> pair_sums(const std::vector<float>& map, double mean) {
  std::vector<Complex> plane(kPlane * kPlane);
  for (std::size_t i = 0; i < map.size(); ++i)
    plane[i / kSide * kPlane + i % kSide] = static_cast<double>(map[i]) - mean;
  plane = transformed(std::move(plane));
  for (Complex& value : plane) value = std::norm(value);
  plane = transformed(std::move(plane));
  std::vector<double> sums;
  for (const Complex& value : plane) sums.push_back(value.real());
  return sums;
}

// Factors of the texture on level ground in a map of 20 NM.
std::vector<float> texture() {
  const model::hrm::GroundTexture made(0.5, kPixel_m);
  std::vector<float> map(kSide * kSide, 1.0F);
  const std::vector<float> none(kSide, 0.0F);
  std::vector<float> north(kSide), east(kSide), factors(kSide + 16);
  constexpr double kDegree_m = 111120.0;
  const double east_degree_m = kDegree_m * std::cos(37.5 * std::numbers::pi / 180.0);
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t i = 0; i < kSide; ++i) {
      north[i] = static_cast<float>(0.3 + static_cast<double>(row) * kPixel_m / kDegree_m);
      east[i] = static_cast<float>(0.3 + static_cast<double>(i) * kPixel_m / east_degree_m);
    }
    factors.assign(factors.size(), 1.0F);
    made.modulate({{37, -122}, none, none, north, east}, factors.data());
    std::copy_n(factors.begin(), kSide, map.begin() + static_cast<std::ptrdiff_t>(row * kSide));
  }
  return map;
}

TEST(Truth, GroundInPatchMapsHasNoPeriod) {
  const std::vector<float> map = texture();
  double mean = 0.0;
  for (const float factor : map) mean += static_cast<double>(factor) / static_cast<double>(map.size());
  const std::vector<double> sums = pair_sums(map, mean);
  double greatest = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double rows = static_cast<double>(std::min(i / kPlane, kPlane - i / kPlane));
    const double columns = static_cast<double>(std::min(i % kPlane, kPlane - i % kPlane));
    if (std::hypot(rows, columns) * kPixel_m < 500.0) continue;
    greatest = std::max(greatest, std::abs(sums[i]) / sums[0]);
  }
  const std::string nature = "level ground of one kind has no period";
  expect_row({"Texture", "greatest autocorrelation of the texture of a map of 20 NM, lags from 500 m", 0.0, 0.1, "",
              nature, "chance: the map has some ten thousand patches"},
             greatest);
  expect_row(
      {"Texture", "mean of the texture's factor", 1.0, 0.02, "", "a factor that keeps the mean of gamma", "chance"},
      mean);
}

}  // namespace
}  // namespace yars::truth
