// Rows of the texture of the ground in patch maps and sweeps: ground has no period and no lattice.
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "model/hrm/ground_detail.hpp"
#include "model/physics/clutter.hpp"
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

double mean_of(const std::vector<float>& map) {
  double mean = 0.0;
  for (const float value : map) mean += static_cast<double>(value) / static_cast<double>(map.size());
  return mean;
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
  const double mean = mean_of(map);
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

constexpr double kCell_m = 64.0;
constexpr double kPart_m = kCell_m / 4.0;  // between the positions

// Levels of the texture of sweeps on a map with its middle at a latitude. Rows run east, and tangent to the parallel.
std::vector<float> sweep_texture(double latitude_deg) {
  const model::physics::GroundGrid grid = model::physics::make_ground_grid(kCell_m);
  const double from_pole_m = (90.0 - latitude_deg) * model::physics::kGridMetresPerDegree;
  const double cosine = std::cos(latitude_deg * std::numbers::pi / 180.0);
  std::vector<float> map;
  for (std::size_t row = 0; row < kSide; ++row)
    for (std::size_t column = 0; column < kSide; ++column) {
      const double north_m = (static_cast<double>(row) - 0.5 * kSide) * kPart_m;
      const double east_m = (static_cast<double>(column) - 0.5 * kSide) * kPart_m;
      geo::GeoPoint position{latitude_deg + north_m / model::physics::kGridMetresPerDegree,
                             east_m / (model::physics::kGridMetresPerDegree * cosine)};
      if (latitude_deg > 89.0)
        position = {90.0 - std::hypot(from_pole_m - north_m, east_m) / model::physics::kGridMetresPerDegree,
                    std::atan2(east_m, from_pole_m - north_m) * 180.0 / std::numbers::pi};
      map.push_back(static_cast<float>(model::physics::ground_bits(grid, position) >> 24U));
    }
  return map;
}

// Magnitude of the steps to the next position east or north: large at the edges of cells.
std::vector<float> steps(const std::vector<float>& map, std::size_t stride) {
  std::vector<float> found;
  for (std::size_t i = 0; i < map.size(); ++i)
    found.push_back(
        i + stride < map.size() && (stride > 1 || i % kSide + 1 < kSide) ? std::abs(map[i + stride] - map[i]) : 0.0F);
  return found;
}

// Greatest autocorrelation at lags beyond two cells.
double greatest_beyond_two_cells(const std::vector<float>& map) {
  const std::vector<double> sums = pair_sums(map, mean_of(map));
  double greatest = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double rows = static_cast<double>(std::min(i / kPlane, kPlane - i / kPlane));
    const double columns = static_cast<double>(std::min(i % kPlane, kPlane - i % kPlane));
    if (std::hypot(rows, columns) * kPart_m > 2.0 * kCell_m) greatest = std::max(greatest, std::abs(sums[i]) / sums[0]);
  }
  return greatest;
}

TEST(Truth, GroundInSweepsHasNoLattice) {
  const std::string nature = "level ground of one kind has neither rows nor columns";
  for (const auto& [at, latitude_deg] : {std::pair("37° N", 37.0), {"89.9° N", 89.9}}) {
    const std::vector<float> map = sweep_texture(latitude_deg);
    const std::string where = std::string(" beyond 2 cells at ") + at;
    expect_row({"Texture", "greatest autocorrelation of the texture of sweeps" + where, 0.0, 0.1, "", nature,
                "chance: the map has 16,000 cells"},
               greatest_beyond_two_cells(map));
    expect_row({"Texture", "greatest autocorrelation of the edges of cells to the east" + where, 0.0, 0.1, "", nature,
                "chance: the map has 16,000 cells"},
               greatest_beyond_two_cells(steps(map, 1)));
    expect_row({"Texture", "greatest autocorrelation of the edges of cells to the north" + where, 0.0, 0.1, "", nature,
                "chance: the map has 16,000 cells"},
               greatest_beyond_two_cells(steps(map, kSide)));
    const std::vector<double> sums = pair_sums(map, mean_of(map));
    expect_row(
        {"Texture", std::string("autocorrelation half a cell east over that half a cell north at ") + at, 1.0, 0.15, "",
         "level ground of one kind is alike in all directions", "the cells of a degree of latitude have one width"},
        sums[2] / sums[2 * kPlane]);
  }
}

}  // namespace
}  // namespace yars::truth
