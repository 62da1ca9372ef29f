#include "model/physics/clutter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "lib/geo/quantity.hpp"
#include "lib/memory/computed_once.hpp"
#include "lib/random/counter_rng.hpp"
#include "model/physics/receiver.hpp"

namespace yars::model::physics {

NoiseState make_noise_state(const NoiseKey& key) {
  const std::uint64_t scan_and_sweep = (static_cast<std::uint64_t>(key.scan) << 32U) | key.sweep;
  const std::uint64_t bits = random::splitmix64(random::splitmix64(key.seed) ^ scan_and_sweep);
  return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32U)};
}

namespace {
// Regularized upper incomplete gamma function of a shape n that is a whole number, and the last term of its sum
// e^-x (1 + x + ... + x^(n-1) / (n-1)!), which is the gamma density at x.
struct WholeGamma {
  double upper, density;
};
WholeGamma whole_gamma(int shape, double x) {
  double term = std::exp(-x), sum = term;
  for (int k = 1; k < shape; ++k) sum += term *= x / k;
  return {sum, term};
}

// Levels are means of intervals that are equally probable. The edges come one after the other by Newton's method, each
// from the one before. The integral of x p(x), p the gamma density of shape n, is n times the distribution of shape
// n + 1.
std::unique_ptr<const SpeckleLevels> computed_speckle(int looks) {
  constexpr auto kLevels = static_cast<double>(kSpeckleLevels);
  constexpr double kConverged = 1e-12;  // relative change of an edge that ends the iteration
  constexpr int kMaxSteps = 50;
  auto levels = std::make_unique<SpeckleLevels>();
  double edge = std::pow(std::tgamma(looks + 1.0) / kLevels, 1.0 / looks);  // the first, where x is small
  double beyond = 1.0;                                                      // share of the mean beyond the edge
  for (std::size_t i = 0; i < kSpeckleLevels; ++i) {
    const double upper = 1.0 - static_cast<double>(i + 1) / kLevels;
    double rest = 0.0;
    if (i + 1 < kSpeckleLevels) {
      double change = edge;
      for (int step = 0; step < kMaxSteps && std::abs(change) > kConverged * edge; ++step) {
        const WholeGamma at = whole_gamma(looks, edge);
        change = (at.upper - upper) / at.density;
        edge += change;
      }
      rest = whole_gamma(looks + 1, edge).upper;
    }
    (*levels)[i] = static_cast<float>((beyond - rest) * kLevels);
    beyond = rest;
  }
  return levels;
}
}  // namespace

const SpeckleLevels& speckle_levels(int looks) {
  static std::array<memory::ComputedOnce<SpeckleLevels>, kMaxLooks + 1> known;
  return known.at(static_cast<std::size_t>(looks)).get([&] { return computed_speckle(looks); });
}

SpeckleCells speckle_cells(double spacing_m, double pulse_length_m, NoiseState state) {
  if (!(pulse_length_m > spacing_m)) return {};
  constexpr float kStep = 1.0F / 16777216.0F;
  const auto uniform = [](std::uint32_t bits) { return kStep * static_cast<float>(bits >> 8U); };
  return {static_cast<float>(spacing_m / pulse_length_m), uniform(state.first), uniform(state.second)};
}

namespace {
// Parts round the earth at a latitude, those of whole cells.
double columns_at(const GroundGrid& grid, double latitude_deg) {
  const double around = 360.0 * grid.rows_per_degree * std::cos(latitude_deg * geo::kRadiansPerDegree);
  return kPartsPerCell * std::max(1.0, std::round(around / kPartsPerCell));
}
}  // namespace

GroundGrid make_ground_grid(double edge_m) {
  GroundGrid grid;
  grid.rows_per_degree = kPartsPerCell * kGridMetresPerDegree / edge_m;
  for (std::size_t band = 0; band < grid.columns.size(); ++band)
    grid.columns[band] = columns_at(grid, static_cast<double>(band) - 89.5);
  return grid;
}

TextureDrift make_texture_drift(const GroundGrid& grid, double north_m, double east_m, double lives) {
  const double parts_per_m = grid.rows_per_degree / kGridMetresPerDegree;
  // A position has the cell from where the texture came. A drift of 0 is in the middle of the period.
  const auto back = [](double parts) {
    const double periods = 0.5 - parts / TextureDrift::kPeriod;
    return TextureDrift::kPeriod * (periods - std::floor(periods));
  };
  const double rows = back(north_m * parts_per_m), columns = back(east_m * parts_per_m);
  TextureDrift drift;
  drift.row = static_cast<std::int32_t>(rows);
  drift.column = static_cast<std::int32_t>(columns);
  drift.row_part = rows - std::floor(rows);
  drift.column_part = columns - std::floor(columns);
  const double age = std::floor(256.0 * lives);
  drift.age = static_cast<std::uint32_t>(static_cast<std::int64_t>(age));
  drift.moves = true;
  return drift;
}

std::uint32_t ground_bits(const GroundGrid& grid, geo::GeoPoint position) {
  return drifted_bits(grid, position, {});
}

std::uint32_t drifted_bits(const GroundGrid& grid, geo::GeoPoint position, const TextureDrift& drift) {
  const double north_deg = position.latitude_deg + 90.0;
  const auto band = static_cast<std::size_t>(std::clamp(north_deg, 0.0, 179.0));
  const double turns = position.longitude_deg / 360.0 + 0.5;
  // The integers are signed, because SIMD converts floating point directly to signed integers only.
  const double rows = std::max(0.0, north_deg * grid.rows_per_degree) + drift.row_part;
  const auto row = static_cast<std::uint32_t>(static_cast<std::int32_t>(rows) + drift.row);
  const auto column_of = [&](double columns) {
    const double east = (turns - std::floor(turns)) * columns + drift.column_part;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(east) + drift.column);
  };
  double columns = grid.columns[band];
  std::uint32_t column = column_of(columns);
  const std::uint32_t part = random::lowbias32((row * kGoldenSection + column) ^ kPartKey);
  const std::uint32_t cell_row = (row + (part >> 30U)) / kPartsPerCell;
  if (std::abs(position.latitude_deg) > kPolar_deg) {
    const double middle_row = (cell_row + 0.5) * kPartsPerCell - drift.row;
    columns = columns_at(grid, std::clamp(middle_row / grid.rows_per_degree - 90.0, -90.0, 90.0));
    column = column_of(columns);
  }
  std::uint32_t cell_column = (column + (part >> 28U & 3U)) / kPartsPerCell;
  if (!drift.moves && cell_column * kPartsPerCell >= static_cast<std::uint32_t>(columns)) cell_column = 0;
  const std::uint32_t cell = cell_row * kGoldenSection + cell_column;
  if (!drift.moves) return random::lowbias32(cell);
  const std::uint32_t life = (drift.age + (random::lowbias32(cell ^ kLifeSection) >> 24U)) >> 8U;
  return random::lowbias32(cell + life * kLifeSection);
}

namespace {
constexpr double kConverged = 1e-15;  // relative size of a term or a correction that ends the iteration
constexpr int kMaxTerms = 10000;      // bounds the time of a series that does not converge

// Regularized lower incomplete gamma function by its power series; used for x < shape + 1.
double lower_series(double shape, double x) {
  double term = 1.0 / shape;
  double sum = term;
  for (int n = 1; n < kMaxTerms && term > sum * kConverged; ++n) {
    term *= x / (shape + n);
    sum += term;
  }
  return sum * std::exp(shape * std::log(x) - x - std::lgamma(shape));
}

// Regularized upper incomplete gamma function: x^s e^-x / Gamma(s), divided by the continued fraction
// x + 1 - s - 1(1 - s)/(x + 3 - s - 2(2 - s)/(...)). s is the shape. Lentz's method; used for x >= shape + 1.
double upper_fraction(double shape, double x) {
  double b = x + 1.0 - shape;
  double d = 1.0 / b;
  double c = 1e300;
  double product = d;
  for (int n = 1; n < kMaxTerms; ++n) {
    const double a = -n * (n - shape);
    b += 2.0;
    d = 1.0 / (a * d + b);
    c = b + a / c;
    product *= c * d;
    if (std::abs(c * d - 1.0) < kConverged) break;
  }
  return product * std::exp(shape * std::log(x) - x - std::lgamma(shape));
}

// The x > low at which incomplete_gamma(shape, x) equals a probability, by Newton's method with bisection as safeguard.
double quantile(double shape, double probability, double low) {
  double high = std::max(2.0 * low, shape + 1.0);
  while (incomplete_gamma(shape, high) < probability) high *= 2.0;
  double x = 0.5 * (low + high);
  for (int step = 0; step < 60 && high - low > 1e-9 * high; ++step) {
    const double excess = incomplete_gamma(shape, x) - probability;
    (excess < 0.0 ? low : high) = x;
    if (std::abs(excess) < 1e-12) break;
    const double density = std::exp((shape - 1.0) * std::log(x) - x - std::lgamma(shape));
    const double next = x - excess / density;
    x = next > low && next < high ? next : 0.5 * (low + high);
  }
  return x;
}
}  // namespace

double incomplete_gamma(double shape, double x) {
  if (!(x > 0.0)) return 0.0;
  return x < shape + 1.0 ? lower_series(shape, x) : 1.0 - upper_fraction(shape, x);
}

namespace {
TextureLevels computed_levels(double shape) {
  TextureLevels levels;
  levels.fill(1.0F);
  if (!(shape > 0.0)) return levels;
  // The mean over an interval is an integral of x p(x), p the gamma density. x p(x) is the mean of the distribution
  // times the gamma density of shape + 1.
  double previous_mean = 0.0;
  double edge = 0.0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const bool last = i + 1 == levels.size();
    const double probability = static_cast<double>(i + 1) / static_cast<double>(levels.size());
    if (!last) edge = quantile(shape, probability, edge);
    const double cumulative_mean = last ? 1.0 : incomplete_gamma(shape + 1.0, edge);
    levels[i] = static_cast<float>((cumulative_mean - previous_mean) * static_cast<double>(levels.size()));
    previous_mean = cumulative_mean;
  }
  return levels;
}
}  // namespace

TextureLevels make_texture_levels(double shape) {
  // The levels of a thread's last shapes. Objects of the same radar, such as its next scan, take them from here.
  struct Known {
    double shape = std::numeric_limits<double>::quiet_NaN();
    TextureLevels levels;
  };
  thread_local std::array<Known, 8> known;
  thread_local std::size_t oldest = 0;
  const auto found = std::ranges::find(known, shape, &Known::shape);
  if (found != known.end()) return found->levels;
  Known& replaced = known[oldest++ % known.size()];
  replaced = {shape, computed_levels(shape)};
  return replaced.levels;
}

double texture_cell_m(double pulse_length_m, double spacing_m) {
  return std::exp2(std::ceil(std::log2(std::max({pulse_length_m, spacing_m, 1.0}))));
}

}  // namespace yars::model::physics
