// MagneticField with a dipole, whose variation is known in closed form. The test writes the two files that
// GeographicLib reads (its format "WMMF-1": metadata, and Schmidt coefficients as binary numbers).
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "lib/geo/geodesy.hpp"

namespace yars::geo {
namespace {

class Magnetic : public ::testing::Test {
 protected:
  Magnetic() : folder_(std::filesystem::temp_directory_path() / ("yars_magnetic_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Magnetic() override { std::filesystem::remove_all(folder_); }

  // Writes a model with coefficients of degree 1 [nT]: along the earth's axis, towards 0 E, towards 90 E.
  void write_dipole(double g10, double g11, double h11) const {
    std::ofstream metadata(folder_ / "dipole.wmm");
    metadata << "WMMF-1\nName dipole\nDescription made up\nReleaseDate 2020-01-01\nRadius 6371200\nNumModels 1\n"
                "Epoch 2020\nDeltaEpoch 5\nMinTime 2020\nMaxTime 2025\nMinHeight -1000\nMaxHeight 850000\n"
                "Type Linear\nNormalization Schmidt\nByteOrder little\nID DIPOLE01\n";
    std::ofstream data(folder_ / "dipole.wmm.cof", std::ios::binary);
    data.write("DIPOLE01", 8);
    // Coefficients of the field, then of its annual change, which are 0. Each block: degree and order 1, coefficients
    // of the cosines by order, then of the sines.
    for (const double scale : {1.0, 0.0}) {
      const std::int32_t sizes[2] = {1, 1};
      data.write(reinterpret_cast<const char*>(sizes), sizeof sizes);
      const double numbers[4] = {0.0, scale * g10, scale * g11, scale * h11};
      data.write(reinterpret_cast<const char*>(numbers), sizeof numbers);
    }
  }
  MagneticField field() const { return {"dipole", folder_.string()}; }

  std::filesystem::path folder_;
};

TEST_F(Magnetic, ADipoleAlongTheAxisHasNoVariation) {
  write_dipole(-30'000.0, 0.0, 0.0);
  const MagneticField axial = field();
  ASSERT_TRUE(axial.has_data()) << axial.problem();
  for (const double longitude_deg : {-120.0, 0.0, 77.0})
    EXPECT_NEAR(axial.variation_deg({40.0, longitude_deg}, HeightAboveEllipsoid::metres(5000.0), 2022.0), 0.0, 1e-9);
}

TEST_F(Magnetic, ATiltedDipolePointsAtItsPole) {
  // The pole of the dipole is at 80 N 70 W. The field points along the great circle to the pole.
  const double colatitude = 10.0 * kRadiansPerDegree, longitude = -70.0 * kRadiansPerDegree;
  write_dipole(-30'000.0 * std::cos(colatitude), -30'000.0 * std::sin(colatitude) * std::cos(longitude),
               -30'000.0 * std::sin(colatitude) * std::sin(longitude));
  const MagneticField tilted = field();
  ASSERT_TRUE(tilted.has_data()) << tilted.problem();
  for (const double at_deg : {-160.0, -120.0, -70.0, 10.0}) {
    // Bearing of the great circle from the equator to a pole 10 degrees from the axis, by spherical trigonometry.
    const double turn = (-70.0 - at_deg) * kRadiansPerDegree;
    const double expected_deg =
        std::atan2(std::sin(turn) * std::sin(colatitude), std::cos(colatitude)) / kRadiansPerDegree;
    EXPECT_NEAR(tilted.variation_deg({0.0, at_deg}, HeightAboveEllipsoid::metres(0.0), 2022.0), expected_deg, 0.05)
        << at_deg;
  }
}

TEST_F(Magnetic, AYearAfterTheModelsLastYearGivesTheVariationOfItsLastYear) {
  write_dipole(-30'000.0, 2'000.0, 3'000.0);
  const MagneticField field_now = field();
  const auto at = [&](double year) {
    return field_now.variation_deg({40.0, 10.0}, HeightAboveEllipsoid::metres(0.0), year);
  };
  EXPECT_EQ(at(2050.0), at(2025.0));
}

TEST_F(Magnetic, WithoutDataTheVariationIsNanAndTheProblemNamesTheFile) {
  const MagneticField none = field();
  EXPECT_FALSE(none.has_data());
  EXPECT_NE(none.problem().find("dipole.wmm"), std::string::npos);
  EXPECT_TRUE(std::isnan(none.variation_deg({40.0, 10.0}, HeightAboveEllipsoid::metres(0.0), 2022.0)));
}

// The World Magnetic Model, if it is installed. NOAA's calculator gives 12.9 E for Monterey in 2020.0.
TEST(WorldMagneticModel, HasTheVariationThatIsPublished) {
  const MagneticField world("wmm2020", "");
  if (!world.has_data()) GTEST_SKIP() << "no data of the World Magnetic Model here: " << world.problem();
  EXPECT_NEAR(world.variation_deg({36.6, -121.9}, HeightAboveEllipsoid::metres(0.0), 2020.0), 12.9, 0.3);
}

}  // namespace
}  // namespace yars::geo
