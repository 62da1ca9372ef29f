#include "model/hrm/ground_detail.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lib/geo/quantity.hpp"
#include "lib/random/counter_rng.hpp"
#include "model/hrm/polar_ground_simd.hpp"
#include "model/physics/clutter.hpp"
#include "model/terrain/sampling/height_simd.hpp"

namespace yars::model::hrm {

namespace {
constexpr int kFinestEdge = 512;          // [texels] 512^2 words of 4 bytes are 1 MiB and fit the L2 cache
constexpr double kFinestTexel_m = 4.0;    // [m] speckle would hide a finer texture
constexpr double kLongestWave_m = 256.0;  // [m] terrain posts resolve longer features
constexpr double kTile_m = 1200.0;        // [m] between tiles; a tile is at most 1560 m wide and fits every table
constexpr double kMaxByte = 255.0;
constexpr std::uint32_t kSeed = 0x59a75u;  // fixed, so that the texture is the same in every run

// A square lattice of random knots that repeats with the table: `a` and `b` cells of the lattice lie along and across
// an edge of the table, so the lattice is turned by atan(b / a).
struct Lattice {
  int a = 1, b = 0;
  int edge = 1;  // [texels] of the table

  // Value between the knots at a texel, smooth.
  void add_to(std::vector<float>& table) const {
    double corners[4] = {};
    int i = -edge, j = -edge;  // of the cell of `corners`; none yet
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        const double u = static_cast<double>(a * x + b * y) / edge + b;  // b: so that v is positive
        const double v = static_cast<double>(a * y - b * x) / edge + b;
        if (static_cast<int>(u) != i || static_cast<int>(v) != j) {
          i = static_cast<int>(u);
          j = static_cast<int>(v);
          for (int k = 0; k < 4; ++k) corners[k] = knot(i + k % 2, j + k / 2);
        }
        const double along = random::smooth_step(0.0, 1.0, u - i);
        const double across = random::smooth_step(0.0, 1.0, v - j);
        const double low = corners[0] + along * (corners[1] - corners[0]);
        const double high = corners[2] + along * (corners[3] - corners[2]);
        table[static_cast<std::size_t>(y) * static_cast<std::size_t>(edge) + static_cast<std::size_t>(x)] +=
            static_cast<float>(low + across * (high - low));
      }
    }
  }

  // Equal for knots that are an edge of the table apart. Even in [-1, 1).
  double knot(int i, int j) const {
    const int knots = a * a + b * b;  // of the table
    const auto wrapped = [knots](int k) { return (k % knots + knots) % knots; };
    return 2.0 * random::unit_fraction(
                     random::lattice_hash(wrapped(a * i - b * j), wrapped(b * i + a * j), knots, kSeed)) -
           1.0;
  }
};

// Periodic fractal noise of mean 0 and variance 1. Octaves from kLongestWave_m down to two texels have equal
// amplitudes. Each has a turned companion of 1 / 1.618 of its wave, which hides the axes of the table.
std::vector<float> fractal_table(int edge, double texel_m) {
  constexpr double kTurnCosine = 0.342, kTurnSine = 0.940, kStretch = 1.618;
  std::vector<float> table(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge), 0.0F);
  for (double wave_m = kLongestWave_m; wave_m >= 2.0 * texel_m; wave_m *= 0.5) {
    const double cells = edge * texel_m / wave_m;
    Lattice{std::max(1, static_cast<int>(std::lround(cells))), 0, edge}.add_to(table);
    Lattice{static_cast<int>(std::lround(cells * kStretch * kTurnCosine)),
            static_cast<int>(std::lround(cells * kStretch * kTurnSine)), edge}
        .add_to(table);
  }
  double sum = 0.0;
  double squares = 0.0;
  for (const float value : table) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * static_cast<double>(value);
  }
  const double mean = sum / static_cast<double>(table.size());
  const double deviation = std::sqrt(std::max(squares / static_cast<double>(table.size()) - mean * mean, 1e-12));
  for (float& value : table) value = static_cast<float>((static_cast<double>(value) - mean) / deviation);
  return table;
}

// Makes the field the fourth root of a texture that is log-normal with mean 1. `contrast`: standard deviation of the
// texture's logarithm. Bilinear samples smooth the texture, so its mean is that of samples, one in each texel.
void shape(std::vector<float>& field, int edge, double contrast) {
  for (float& value : field) value = static_cast<float>(std::exp(0.25 * contrast * static_cast<double>(value)));
  const auto size = static_cast<std::size_t>(edge);
  double total = 0.0;
  for (std::size_t y = 0; y < size; ++y) {
    for (std::size_t x = 0; x < size; ++x) {
      const auto at = [&](std::size_t i, std::size_t j) {
        return static_cast<double>(field[(y + j) % size * size + (x + i) % size]);
      };
      const double along = 0.125 + 0.25 * static_cast<double>((x + 2 * y) % 4);
      const double across = 0.125 + 0.25 * static_cast<double>((x / 4 + y) % 4);
      const double low = at(0, 0) + along * (at(1, 0) - at(0, 0));
      const double high = at(0, 1) + along * (at(1, 1) - at(0, 1));
      const double square = (low + across * (high - low)) * (low + across * (high - low));
      total += square * square;
    }
  }
  const auto scale = static_cast<float>(std::pow(static_cast<double>(field.size()) / total, 0.25));
  for (float& value : field) value *= scale;
}
}  // namespace

namespace {
struct Texels {
  double width_m;
  int edge;  // of the texture
};

// A texel is at least half the spacing of the positions, because a finer texture would alias. All tables have the same
// side in metres, so that the ground looks the same in maps of every window. The smallest table has one block
// (kDetailBlock texels per side).
Texels texels_for(double pixel_m) {
  Texels texels{kFinestTexel_m, kFinestEdge};
  while (texels.width_m < 0.5 * pixel_m && texels.edge > simd::kDetailBlock) {
    texels.width_m *= 2.0;
    texels.edge /= 2;
  }
  return texels;
}
}  // namespace

bool GroundTexture::fits(double pixel_m) const {
  return texels_for(pixel_m).width_m == texel_m();
}

GroundTexture::GroundTexture(double contrast, double pixel_m) : edge_(texels_for(pixel_m).edge) {
  const double texel_m = texels_for(pixel_m).width_m;
  texels_per_metre_ = static_cast<float>(1.0 / texel_m);
  std::vector<float> field = fractal_table(edge_, texel_m);
  shape(field, edge_, contrast);
  const auto [lowest, highest] = std::minmax_element(field.begin(), field.end());
  mean_ = std::accumulate(field.begin(), field.end(), 0.0) / static_cast<double>(field.size());
  lowest_ = static_cast<double>(*lowest);
  step_ = std::max(static_cast<double>(*highest) - lowest_, 1e-6) / kMaxByte;
  fill_table(field);
}

void GroundTexture::fill_table(const std::vector<float>& field) {
  const auto edge = static_cast<std::size_t>(edge_);
  table_.resize(field.size());
  const auto byte = [&](std::size_t x, std::size_t y) {
    return static_cast<std::uint32_t>(
        std::lround((static_cast<double>(field[y % edge * edge + x % edge]) - lowest_) / step_));
  };
  constexpr std::size_t kBlock = simd::kDetailBlock;
  for (std::size_t y = 0; y < edge; ++y)
    for (std::size_t x = 0; x < edge; ++x)
      table_[y / kBlock * kBlock * edge + x / kBlock * kBlock * kBlock + y % kBlock * kBlock + x % kBlock] =
          byte(x, y) | byte(x + 1, y) << 8 | byte(x, y + 1) << 16 | byte(x + 1, y + 1) << 24;
}

namespace {
geo::GeoPoint middle_of_cell(const terrain::PositionRun& positions, std::size_t i) {
  return {positions.corner.south_deg + static_cast<double>(positions.cells_north[i]) + 0.5,
          positions.corner.west_deg + static_cast<double>(positions.cells_east[i]) + 0.5};
}

std::uint32_t seed_of_cell(geo::GeoPoint middle) {
  const auto east = static_cast<int>(std::floor(middle.longitude_deg)) + 1080;  // positive
  return static_cast<std::uint32_t>(
      random::lattice_hash(static_cast<int>(std::floor(middle.latitude_deg)), east % 360, 0, kSeed));
}
}  // namespace

// Texture coordinates count from the south-west corner of a one-degree cell. Throughout a cell, a degree of longitude
// has the length that it has at the cell's middle latitude. The vector loop is called once for each run of successive
// positions in one cell.
void GroundTexture::modulate(const terrain::PositionRun& positions, float* gamma) const {
  const simd::DetailTable table{.texels = table_.data(),
                                .edge = edge_,
                                .mean = static_cast<float>(mean_),
                                .low = static_cast<float>(lowest_ - mean_),
                                .step = static_cast<float>(step_),
                                .tiles_per_texel = static_cast<float>(texel_m() / kTile_m)};
  const auto north_scale = static_cast<float>(physics::kGridMetresPerDegree) * texels_per_metre_;
  const std::size_t count = positions.north_deg.size();
  std::size_t first = 0;
  while (first < count) {
    const std::size_t last = first + terrain::sampling::same_cell_count(&positions.cells_north[first],
                                                                        &positions.cells_east[first], count - first);
    const geo::GeoPoint middle = middle_of_cell(positions, first);
    const auto east_scale = north_scale * static_cast<float>(std::cos(middle.latitude_deg * geo::kRadiansPerDegree));
    // Vectors write beyond the end of a run, so the gammas of the next run are saved and restored.
    std::array<float, terrain::kRunSlack> overrun{};
    const std::size_t saved = std::min(overrun.size(), count - last);
    std::copy_n(gamma + last, saved, overrun.begin());
    simd::modulate(last - first, table, seed_of_cell(middle), &positions.east_deg[first], &positions.north_deg[first],
                   east_scale, north_scale, gamma + first);
    std::copy_n(overrun.begin(), saved, gamma + last);
    first = last;
  }
}

}  // namespace yars::model::hrm
