// Statistics of speckle on a uniform field: at the centres of resolution cells, and between them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "lib/radar/mission.hpp"
#include "model/hrm/map_image.hpp"
#include "tests/lib/simd/vector_targets.hpp"

namespace yars::test {
namespace {

namespace hrm = model::hrm;

struct Moments {
  double count = 0.0, sum = 0.0, squares = 0.0;
  void add(double value) {
    count += 1.0;
    sum += value;
    squares += value * value;
  }
  double mean() const { return sum / count; }
  double variance() const { return squares / count - mean() * mean(); }
};

TEST(UniformField, HasAVarianceOfItsMeanSquaredOverTheLooks) {
  radar::RadarConfiguration configuration;
  configuration.high_resolution.dynamic_range_db = 60.0;
  configuration.high_resolution.brightest_gamma_db = 14.0;
  for (const int size : {240, 480, 777, 1024}) {
    hrm::MapImage image(size);
    image.power.assign(image.power.size(), 1.0F);
    for (const int looks : {1, 2, 3, 5}) {
      std::vector<std::uint8_t> picture;
      picture.resize(image.power.size());
      hrm::form_video(configuration.high_resolution, image, {0.0, looks, 1}, 0, image.size, picture);
      Moments moments;
      for (const std::uint8_t level : picture) moments.add(std::pow(10.0, 0.1 * (60.0 / 255.0 * level - 60.0 + 14.0)));
      const double relative_variance = moments.variance() / (moments.mean() * moments.mean());
      EXPECT_NEAR(relative_variance * looks, 1.0, size < 480 ? 0.05 : 0.03) << size << ' ' << looks;
      EXPECT_NEAR(moments.mean(), 1.0, 0.02) << size << ' ' << looks;
    }
  }
}

TEST(Speckle, HasEqualMeanAndVarianceAtAllPixelPositionsInACell) {
  constexpr int kSize = 960;  // two pixels per resolution cell, in rows and in columns
  constexpr int kLooks = 2;
  Moments moments[2][2];
  for (std::uint32_t map = 0; map < 3; ++map) {
    hrm::Speckle speckle(kSize, kLooks, 5, map);
    for (int row = 0; row < kSize; ++row) {
      const float* factors = speckle.row(row);
      for (int column = 0; column < kSize; ++column)
        moments[row % 2][column % 2].add(static_cast<double>(factors[column]));
    }
  }
  for (const auto& line : moments) {
    for (const Moments& at : line) {
      EXPECT_NEAR(at.mean(), 1.0, 0.006);
      EXPECT_NEAR(at.variance() * kLooks, 1.0, 0.03);
    }
  }
}

TEST(Speckle, IsCorrelatedWithinACellAndNotThreeCellsApart) {
  constexpr int kSize = 960;
  hrm::Speckle speckle(kSize, 1, 5, 1);
  double near = 0.0;
  double far = 0.0;
  double count = 0.0;
  for (int row = 0; row < kSize; ++row) {
    const float* factors = speckle.row(row);
    for (int column = 0; column + 8 < kSize; ++column) {
      const double here = static_cast<double>(factors[column]) - 1.0;
      near += here * (static_cast<double>(factors[column + 1]) - 1.0);
      far += here * (static_cast<double>(factors[column + 6]) - 1.0);
      count += 1.0;
    }
  }
  EXPECT_GT(near / count, 0.5);
  EXPECT_NEAR(far / count, 0.0, 0.02);
}

TEST(Speckle, IsTheSameOnEveryVectorTarget) {
  std::vector<float> first_target;
  for_each_vector_target([&](const char* name) {
    std::vector<float> found;
    for (const int size : {100, 1000}) {
      hrm::Speckle speckle(size, 3, 9, 2);
      for (int row = 0; row < size; row += 3) {
        const float* factors = speckle.row(row);
        found.insert(found.end(), factors, factors + size);
      }
    }
    if (first_target.empty()) first_target = found;
    EXPECT_EQ(found, first_target) << name;
  });
}

}  // namespace
}  // namespace yars::test
