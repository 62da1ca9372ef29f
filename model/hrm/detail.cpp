#include "model/hrm/detail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/geo/quantity.hpp"
#include "model/terrain/noise.hpp"

namespace yars::model::hrm {

namespace {
constexpr int kFinestEdge = 512;        // texels: 1 MiB, which the second-level cache holds
constexpr double kFinestTexel_m = 4.0;  // detail below it is speckle's
constexpr double kCoarsest_m = 256.0;   // [m] longest wave; beyond it the posts say what there is
constexpr double kMetresPerDegree = 60.0 * geo::kMetresPerNauticalMile;
constexpr std::uint32_t kSeed = 0x59a75u;

// The second look at the table: turned by a fifth of a turn or so and stretched by the golden ratio, so that the two
// periods never meet.
constexpr float kTurnCosine = 0.3420201F;  // of 70 degrees
constexpr float kTurnSine = 0.9396926F;
constexpr float kStretch = 1.618034F;

// Periodic fractal noise: octaves from the longest wave down to two texels, each as strong as the one before.
std::vector<float> fractal_table(int edge, double texel_m) {
  std::vector<float> table(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge), 0.0F);
  for (double wave_m = kCoarsest_m; wave_m >= 2.0 * texel_m; wave_m *= 0.5) {
    const int cells = std::max(1, static_cast<int>(std::lround(edge * texel_m / wave_m)));
    const double cell_texels = static_cast<double>(edge) / cells;
    const auto knot = [&](int x, int y) {
      const auto wrapped = [cells](int k) { return (k % cells + cells) % cells; };
      return 2.0 * terrain::share_of(terrain::lattice_hash(wrapped(x), wrapped(y), cells, kSeed)) - 1.0;
    };
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        const double u = x / cell_texels;
        const double v = y / cell_texels;
        const int i = static_cast<int>(u);
        const int j = static_cast<int>(v);
        const double a = terrain::smooth_step(0.0, 1.0, u - i);
        const double b = terrain::smooth_step(0.0, 1.0, v - j);
        const double low = knot(i, j) + a * (knot(i + 1, j) - knot(i, j));
        const double high = knot(i, j + 1) + a * (knot(i + 1, j + 1) - knot(i, j + 1));
        table[static_cast<std::size_t>(y) * static_cast<std::size_t>(edge) + static_cast<std::size_t>(x)] +=
            static_cast<float>(low + b * (high - low));
      }
    }
  }
  return table;
}

// Mean 1; half of the variance, for two of them are multiplied; never below a tenth.
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

Detail::Detail(double contrast, double pixel_m) : pixel_m_(pixel_m), texels_per_metre_(0.0F), edge_(kFinestEdge) {
  // A texel no smaller than half a pixel: finer waves would only flicker.
  double texel_m = kFinestTexel_m;
  while (texel_m < 0.5 * pixel_m && edge_ > 1) {
    texel_m *= 2.0;
    edge_ /= 2;
  }
  texels_per_metre_ = static_cast<float>(1.0 / texel_m);
  table_ = fractal_table(edge_, texel_m);
  shape(table_, contrast);
}

namespace {
// Bilinear, periodic.
struct Table {
  const float* texels;
  int edge;

  float at(float x, float y) const {
    const float column = std::floor(x);
    const float row = std::floor(y);
    const int mask = edge - 1;
    const int i = static_cast<int>(column) & mask;
    const int j = static_cast<int>(row) & mask;
    const int i2 = (i + 1) & mask;
    const int j2 = (j + 1) & mask;
    const float a = x - column;
    const float b = y - row;
    const float low = texels[j * edge + i] + a * (texels[j * edge + i2] - texels[j * edge + i]);
    const float high = texels[j2 * edge + i] + a * (texels[j2 * edge + i2] - texels[j2 * edge + i]);
    return low + b * (high - low);
  }

  float factor(float east, float north) const {
    const float turned_east = kStretch * (kTurnCosine * east - kTurnSine * north);
    const float turned_north = kStretch * (kTurnSine * east + kTurnCosine * north);
    return at(east, north) * at(turned_east, turned_north);
  }
};
}  // namespace

void Detail::modulate(const terrain::PlaceRun& places, float* gain) const {
  const Table table{table_.data(), edge_};
  const auto north_scale = static_cast<float>(kMetresPerDegree) * texels_per_metre_;
  float cell_north = std::numeric_limits<float>::quiet_NaN();
  float east_scale = 0.0F;
  for (std::size_t i = 0; i < places.north_deg.size(); ++i) {
    // Within its cell of one degree a place counts from the cell's corner; degrees of longitude as long as in the
    // cell's middle.
    if (places.cells_north[i] != cell_north) {
      cell_north = places.cells_north[i];
      const double middle_deg = places.corner.south_deg + static_cast<double>(cell_north) + 0.5;
      east_scale = north_scale * static_cast<float>(std::cos(middle_deg * geo::kRadiansPerDegree));
    }
    gain[i] *= table.factor(places.east_deg[i] * east_scale, places.north_deg[i] * north_scale);
  }
}

double Detail::factor(geo::GeoPoint place) const {
  const double south_deg = std::floor(place.latitude_deg);
  const double west_deg = std::floor(place.longitude_deg);
  const double scale = kMetresPerDegree * static_cast<double>(texels_per_metre_);
  const double east = (place.longitude_deg - west_deg) * scale * std::cos((south_deg + 0.5) * geo::kRadiansPerDegree);
  const double north = (place.latitude_deg - south_deg) * scale;
  return static_cast<double>(Table{table_.data(), edge_}.factor(static_cast<float>(east), static_cast<float>(north)));
}

}  // namespace yars::model::hrm
