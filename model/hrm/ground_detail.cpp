#include "model/hrm/ground_detail.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
constexpr float kMaxByte = 255.0F;
constexpr std::uint32_t kSeed = 0x59a75u;  // fixed, so that the texture is the same in every run

// Periodic fractal noise. Octaves from kLongestWave_m down to two texels have equal amplitudes.
std::vector<float> fractal_table(int edge, double texel_m) {
  std::vector<float> table(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge), 0.0F);
  for (int octave = 0; std::ldexp(kLongestWave_m, -octave) >= 2.0 * texel_m; ++octave) {
    const double wave_m = std::ldexp(kLongestWave_m, -octave);
    const int cells = std::max(1, static_cast<int>(std::lround(edge * texel_m / wave_m)));
    const double cell_texels = static_cast<double>(edge) / cells;
    const auto knot = [&](int x, int y) {
      const auto wrapped = [cells](int k) { return (k % cells + cells) % cells; };
      return 2.0 * random::unit_fraction(random::lattice_hash(wrapped(x), wrapped(y), cells, kSeed)) - 1.0;
    };
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        const double u = x / cell_texels;
        const double v = y / cell_texels;
        const int i = static_cast<int>(u);
        const int j = static_cast<int>(v);
        const double a = random::smooth_step(0.0, 1.0, u - i);
        const double b = random::smooth_step(0.0, 1.0, v - j);
        const double low = knot(i, j) + a * (knot(i + 1, j) - knot(i, j));
        const double high = knot(i, j + 1) + a * (knot(i + 1, j + 1) - knot(i, j + 1));
        table[static_cast<std::size_t>(y) * static_cast<std::size_t>(edge) + static_cast<std::size_t>(x)] +=
            static_cast<float>(low + b * (high - low));
      }
    }
  }
  return table;
}

// Makes the noise log-normal with mean 1. The factor on gamma is the product of two samples. The logarithm of a sample
// therefore has half the variance of the factor's logarithm. `contrast`: standard deviation of the factor's logarithm.
void shape(std::vector<float>& table, double contrast) {
  double sum = 0.0;
  double squares = 0.0;
  for (const float value : table) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * static_cast<double>(value);
  }
  const double mean = sum / static_cast<double>(table.size());
  const double deviation = std::sqrt(std::max(squares / static_cast<double>(table.size()) - mean * mean, 1e-12));
  double total = 0.0;
  for (float& value : table) {
    const double shaped = std::exp(contrast / std::sqrt(2.0) * (static_cast<double>(value) - mean) / deviation);
    value = static_cast<float>(shaped);
    total += shaped;
  }
  const auto scale = static_cast<float>(static_cast<double>(table.size()) / total);
  for (float& value : table) value *= scale;
}
}  // namespace

namespace {
struct Texels {
  double width_m;
  int edge;  // of the texture
};

// A texel is at least half the spacing of the positions, because a finer texture would alias. The smallest texture has
// one block (kDetailBlock texels per side).
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
  return texels_for(pixel_m).edge == edge_;
}

GroundTexture::GroundTexture(double contrast, double pixel_m)
    : texels_per_metre_(0.0F), edge_(texels_for(pixel_m).edge) {
  const double texel_m = texels_for(pixel_m).width_m;
  texels_per_metre_ = static_cast<float>(1.0 / texel_m);
  std::vector<float> texels = fractal_table(edge_, texel_m);
  shape(texels, contrast);
  unit_ = *std::max_element(texels.begin(), texels.end()) / kMaxByte;
  fill_table(texels);
}

void GroundTexture::fill_table(const std::vector<float>& texels) {
  const auto edge = static_cast<std::size_t>(edge_);
  table_.resize(texels.size());
  const auto byte = [&](std::size_t x, std::size_t y) {
    return static_cast<std::uint32_t>(std::lround(texels[y % edge * edge + x % edge] / unit_));
  };
  constexpr std::size_t kBlock = simd::kDetailBlock;
  for (std::size_t y = 0; y < edge; ++y)
    for (std::size_t x = 0; x < edge; ++x)
      table_[y / kBlock * kBlock * edge + x / kBlock * kBlock * kBlock + y % kBlock * kBlock + x % kBlock] =
          byte(x, y) | byte(x + 1, y) << 8 | byte(x, y + 1) << 16 | byte(x + 1, y + 1) << 24;
}

// Texture coordinates count from the south-west corner of a one-degree cell. Throughout a cell, a degree of longitude
// has the length that it has at the cell's middle latitude. The vector loop is called once for each run of successive
// positions in one cell.
void GroundTexture::modulate(const terrain::PositionRun& positions, float* gamma) const {
  const simd::DetailTable table{table_.data(), edge_, unit_ * unit_};
  const auto north_scale = static_cast<float>(physics::kGridMetresPerDegree) * texels_per_metre_;
  const std::size_t count = positions.north_deg.size();
  std::size_t first = 0;
  while (first < count) {
    const std::size_t last = first + terrain::sampling::same_cell_count(&positions.cells_north[first],
                                                                        &positions.cells_east[first], count - first);
    const double middle_deg = positions.corner.south_deg + static_cast<double>(positions.cells_north[first]) + 0.5;
    const auto east_scale = north_scale * static_cast<float>(std::cos(middle_deg * geo::kRadiansPerDegree));
    // Vectors write beyond the end of a run, so the gammas of the next run are saved and restored.
    std::array<float, terrain::kRunSlack> overrun{};
    const std::size_t saved = std::min(overrun.size(), count - last);
    std::copy_n(gamma + last, saved, overrun.begin());
    simd::modulate(last - first, table, &positions.east_deg[first], &positions.north_deg[first], east_scale,
                   north_scale, gamma + first);
    std::copy_n(overrun.begin(), saved, gamma + last);
    first = last;
  }
}

}  // namespace yars::model::hrm
