// Geoid with a grid of one height. The test writes the file that GeographicLib reads.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lib/geo/geodesy.hpp"

namespace yars::geo {
namespace {

class GeoidTest : public ::testing::Test {
 protected:
  GeoidTest() { std::filesystem::create_directories(folder_); }
  ~GeoidTest() override { std::filesystem::remove_all(folder_); }

  // A grid of 15 minutes, as of egm96-15, with the height `height_m` everywhere.
  void write_grid(double height_m) const {
    constexpr int kColumns = 1440, kRows = 721;
    constexpr double kOffset_m = -108.0, kScale_m = 0.003;
    std::ofstream file(folder_ / "egm96-15.pgm", std::ios::binary);
    file << "P5\n# Origin 90N 0E\n# AreaOrPoint Point\n# Offset -108\n# Scale 0.003\n"
         << kColumns << ' ' << kRows << "\n65535\n";
    const auto pixel = static_cast<unsigned>((height_m - kOffset_m) / kScale_m + 0.5);
    std::string row;
    for (int column = 0; column < kColumns; ++column)
      row += {static_cast<char>(pixel >> 8U), static_cast<char>(pixel & 0xFFU)};
    for (int i = 0; i < kRows; ++i) file << row;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("yars_geoid_" + std::to_string(::getpid()));
};

TEST_F(GeoidTest, AGridLowersHeightsByThatOfMeanSeaLevel) {
  write_grid(40.5);
  const Geoid geoid(folder_.string());
  ASSERT_TRUE(geoid.has_data()) << geoid.problem();
  EXPECT_EQ(geoid.name(), "egm96-15");
  for (const GeoPoint point : {GeoPoint{37.5, -122.5}, GeoPoint{-90.0, 0.0}, GeoPoint{89.99, 179.99}})
    EXPECT_NEAR(geoid.altitude(point, HeightAboveEllipsoid::metres(1'000.0)).metres(), 959.5, 0.002);
}

TEST_F(GeoidTest, WithoutAGridHeightsAreKept) {
  const Geoid geoid(folder_.string());
  EXPECT_FALSE(geoid.has_data());
  EXPECT_FALSE(geoid.problem().empty());
  EXPECT_EQ(geoid.altitude({37.5, -122.5}, HeightAboveEllipsoid::metres(1'000.0)).metres(), 1'000.0);
}

TEST_F(GeoidTest, ADamagedGridIsNotUsed) {
  std::ofstream(folder_ / "egm96-5.pgm") << "P5 damaged";
  EXPECT_FALSE(Geoid(folder_.string()).has_data());
}

}  // namespace
}  // namespace yars::geo
