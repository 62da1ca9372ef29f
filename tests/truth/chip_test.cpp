// Rows of a measured picture: a single-look chip of an airborne L-band radar over farms and towns.
#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "model/physics/clutter_simd.hpp"
#include "model/physics/texture.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "tests/truth/ledger.hpp"

#ifdef YARS_HAS_GDAL
#include <gdal_priv.h>
#endif

namespace yars::truth {
namespace {

namespace physics = model::physics;

constexpr std::size_t kSide = 250;  // of the chip
constexpr std::size_t kBlock = 10;  // side of a block
constexpr double kBlockPixels = kBlock * kBlock;
const std::string kChip = "sar/winnipeg_uavsar_slc.h5, NASA/JPL UAVSAR, HH";

#ifdef YARS_HAS_GDAL
// Intensities of the chip; empty if GDAL does not read it.
std::vector<float> chip() {
  GDALAllRegister();
  const std::string name = "HDF5:\"" + (test::shared_data() / "sar/winnipeg_uavsar_slc.h5").string() +
                           "\"://science/LSAR/SLC/swaths/frequencyA/HH";
  const GDALDatasetUniquePtr file(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (file == nullptr || file->GetRasterXSize() != kSide || file->GetRasterYSize() != kSide) return {};
  std::vector<std::complex<float>> field(kSide * kSide);
  if (file->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, kSide, kSide, field.data(), kSide, kSide, GDT_CFloat32, 0, 0) !=
      CE_None)
    return {};
  std::vector<float> intensity(field.size());
  std::transform(field.begin(), field.end(), intensity.begin(), [](auto value) { return std::norm(value); });
  return intensity;
}
#endif

// Variance / mean^2 of values.
double spread(std::span<const double> values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(values.size());
  return squares * count / (sum * sum) - 1.0;
}

struct Spreads {
  double within;   // median of the blocks' variance / mean^2
  double between;  // variance / mean^2 of the blocks' means
};

Spreads spreads(const std::vector<float>& intensity) {
  std::vector<double> within, means;
  for (std::size_t top = 0; top < kSide; top += kBlock)
    for (std::size_t left = 0; left < kSide; left += kBlock) {
      std::vector<double> block;
      for (std::size_t i = 0; i < kBlock * kBlock; ++i)
        block.push_back(static_cast<double>(intensity[(top + i / kBlock) * kSide + left + i % kBlock]));
      within.push_back(spread(block));
      double sum = 0.0;
      for (const double value : block) sum += value;
      means.push_back(sum / kBlockPixels);
    }
  std::nth_element(within.begin(), within.begin() + static_cast<std::ptrdiff_t>(within.size() / 2), within.end());
  return {within[within.size() / 2], spread(means)};
}

// A chip of the same size with the speckle of YARS, one look. Each block has one level of a texture.
std::vector<float> made_up(double shape) {
  std::vector<float> intensity(kSide * kSide), row(kSide + 16);
  const physics::NoiseState blocks = physics::make_noise_state({2, 2, 2});
  const physics::TextureLevels levels = physics::make_texture_levels(shape);
  for (std::size_t y = 0; y < kSide; ++y) {
    physics::simd::speckle(kSide, physics::make_noise_state({1, 1, static_cast<std::uint32_t>(y)}), 1, {}, row.data());
    for (std::size_t x = 0; x < kSide; ++x) {
      const auto block = static_cast<std::uint32_t>(y / kBlock * kSide + x / kBlock);
      intensity[y * kSide + x] = row[x] * levels[physics::noise_bits(blocks, block) >> 24U];
    }
  }
  return intensity;
}

TEST(Truth, AMeasuredChipHasSpeckleAndTexture) {
  YARS_NEEDS_SHARED_DATA();
#ifdef YARS_HAS_GDAL
  const std::vector<float> measured = chip();
  ASSERT_FALSE(measured.empty()) << "GDAL does not read " << kChip;
  const Spreads outside = spreads(measured);
  constexpr double kGrazing_deg = 45.0, kCell_m2 = 1000.0;  // about those of a block
  const double slope = physics::weibull_slope(physics::LandKind::rural, kGrazing_deg, kCell_m2);
  const Spreads ours = spreads(made_up(1.0 / physics::inverse_shape_of_slope(slope)));
  expect_row({"Speckle", "variance/mean² within blocks of 10 × 10 pixels of a measured chip, median", outside.within,
              0.1, "", kChip, "625 blocks; the chip's pixels are a little correlated"},
             ours.within);
  expect_row({"Texture", "variance/mean² of the means of blocks of 10 × 10 pixels of a measured chip", outside.between,
              1.7, "", kChip, "a check of kind: other band, angle and place; speckle alone has 0.01"},
             ours.between);
#else
  GTEST_SKIP() << "needs GDAL, which this build is without";
#endif
}

}  // namespace
}  // namespace yars::truth
