// `yars patch --out FILE.tif`: read with GDAL, the map's corners, its centre and a known object are at their positions
// on the earth.
#include <gdal.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/terrain/formats/dted.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "worldgen/scene/openflight_writer.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars {
namespace {

using ::testing::HasSubstr;

constexpr int kSize = 96;

std::string text_of(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.9f", value);
  return text.data();
}

// Geometry of a patch map. The default squint angle keeps the map outside of the blind zone.
struct View {
  geo::GeoPoint aircraft, target;
  double window_nm = 0.67;
  double squint_deg = 50.0;  // angle from the ground track to the line of sight
};

// Runs `yars patch` with further options.
endtoend::Finished patch(const View& view, const std::filesystem::path& out,
                         const std::vector<std::string>& more = {}) {
  const geo::Bearing bearing = geo::geodesic_inverse(view.aircraft, view.target).azimuth_at_start;
  std::vector<std::string> command{"yars", "patch", "--out", out.string(), "--size", std::to_string(kSize)};
  const auto option = [&command](const char* name, double value) {
    command.insert(command.end(), {name, text_of(value)});
  };
  option("--lat", view.aircraft.latitude_deg);
  option("--lon", view.aircraft.longitude_deg);
  option("--target-lat", view.target.latitude_deg);
  option("--target-lon", view.target.longitude_deg);
  option("--window-nm", view.window_nm);
  option("--heading", (bearing - geo::Angle::degrees(view.squint_deg)).degrees());
  command.insert(command.end(), more.begin(), more.end());
  return endtoend::run_program(command);
}

// A raster file opened with GDAL.
class Raster {
 public:
  explicit Raster(const std::filesystem::path& path) {
    GDALAllRegister();
    dataset_ = GDALOpen(path.c_str(), GA_ReadOnly);
    if (dataset_ == nullptr) return;
    GDALGetGeoTransform(dataset_, forward_.data());
    EXPECT_NE(GDALInvGeoTransform(forward_.data(), inverse_.data()), 0);
    const OGRSpatialReferenceH degrees = OSRNewSpatialReference(nullptr);
    OSRImportFromEPSG(degrees, 4326);
    OSRSetAxisMappingStrategy(degrees, OAMS_TRADITIONAL_GIS_ORDER);
    plane_from_degrees_ = OCTNewCoordinateTransformation(degrees, GDALGetSpatialRef(dataset_));
    OSRDestroySpatialReference(degrees);
  }
  ~Raster() {
    if (plane_from_degrees_ != nullptr) OCTDestroyCoordinateTransformation(plane_from_degrees_);
    if (dataset_ != nullptr) GDALClose(dataset_);
  }
  Raster(const Raster&) = delete;
  Raster& operator=(const Raster&) = delete;

  bool open() const { return plane_from_degrees_ != nullptr; }
  GDALRasterBandH band() const { return GDALGetRasterBand(dataset_, 1); }
  // Column and row of a position, from the raster's upper left corner.
  std::array<double, 2> pixel_of(geo::GeoPoint position) const {
    double x = position.longitude_deg;
    double y = position.latitude_deg;
    OCTTransform(plane_from_degrees_, 1, &x, &y, nullptr);
    return {inverse_[0] + x * inverse_[1] + y * inverse_[2], inverse_[3] + x * inverse_[4] + y * inverse_[5]};
  }
  std::vector<float> pixels() const {
    std::vector<float> values(static_cast<std::size_t>(kSize) * kSize);
    EXPECT_EQ(GDALRasterIO(band(), GF_Read, 0, 0, kSize, kSize, values.data(), kSize, kSize, GDT_Float32, 0, 0),
              CE_None);
    return values;
  }

 private:
  GDALDatasetH dataset_ = nullptr;
  OGRCoordinateTransformationH plane_from_degrees_ = nullptr;
  std::array<double, 6> forward_{}, inverse_{};
};

TEST(PatchRaster, CornersEdgesAndCentreHaveTheirPositions) {
  const test::TemporaryFolder folder;
  for (const View& view : {View{{37.6, -122.5}, {37.8, -122.3}, 0.67}, View{{38.0, -115.5}, {38.9, -114.4}, 40.0},
                           View{{78.0, 15.0}, {78.2, 16.5}, 3.3}, View{{89.7, 40.0}, {89.8, -120.0}, 4.7},
                           View{{-16.5, 179.9}, {-16.6, -179.9}, 10.0}, View{{-35.0, 149.0}, {-36.2, 148.9}, 1.3}}) {
    SCOPED_TRACE(view.target.latitude_deg);
    const auto file = folder.path() / "map.tif";
    const auto run = patch(view, file, {"--force"});
    ASSERT_EQ(run.code, 0) << run.errors;
    const Raster raster(file);
    ASSERT_TRUE(raster.open());
    model::hrm::PatchOrder order;
    order.apex = view.aircraft;
    order.centre = view.target;
    order.window = geo::Length::nautical_miles(view.window_nm);
    const model::hrm::PatchGeometry geometry(order, radar::RadarConfiguration(), 0.0);
    for (const double right : {-0.5, 0.0, 0.5}) {
      for (const double up : {-0.5, 0.0, 0.5}) {
        const auto pixel =
            raster.pixel_of(geometry.position_of({right * geometry.window_m(), up * geometry.window_m()}));
        EXPECT_NEAR(pixel[0], (right + 0.5) * kSize, 0.02);
        EXPECT_NEAR(pixel[1], (0.5 - up) * kSize, 0.02);
      }
    }
  }
}

// Parameter: bearing [deg] from the target to the aircraft.
class PatchRasterOf : public ::testing::TestWithParam<double> {};

// A low metal box on level ground, 310 m from the map's centre. GDAL gives its bright pixels the position of the box.
TEST_P(PatchRasterOf, AKnownObjectIsAtItsLatitudeAndLongitude) {
  const test::TemporaryFolder folder;
  const geo::GeoPoint target{37.5, -121.5};
  const auto level = test::cell_of({37, -122}, 121, 121, [](int, int) { return 100; });
  ASSERT_TRUE(model::terrain::write_dted(folder.path(), level, 0));
  const geo::GeoPoint position = geo::geodesic_direct(target, geo::Bearing::degrees(70.0), geo::Length::metres(310.0));
  worldgen::OpenFlightWriter writer(position);
  worldgen::MeshBuilder mesh_builder(writer);
  mesh_builder.kind = {1, 0, 0x808080};
  writer.begin_object("box");
  mesh_builder.box({0.0, 0.0, 0.0}, 30.0, 30.0, 1.0);
  writer.end();
  const auto bytes = writer.take();
  std::ofstream(folder.path() / "box.flt", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const geo::GeoPoint aircraft =
      geo::geodesic_direct(target, geo::Bearing::degrees(GetParam()), geo::Length::nautical_miles(10.0));
  const auto file = folder.path() / "map.tif";
  const auto run = patch(
      {aircraft, target, 0.67}, file,
      {"--terrain", folder.path().string(), "--scene", (folder.path() / "box.flt").string(), "--pixels", "power"});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Raster raster(file);
  ASSERT_TRUE(raster.open());
  const std::vector<float> pixels = raster.pixels();
  const float bright = 0.25F * *std::max_element(pixels.begin(), pixels.end());
  double sum = 0.0, column = 0.0, row = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!(pixels[i] > bright)) continue;
    sum += 1.0;
    column += static_cast<double>(i % kSize) + 0.5;
    row += static_cast<double>(i / kSize) + 0.5;
  }
  const auto wanted = raster.pixel_of(position);
  EXPECT_NEAR(column / sum, wanted[0], 1.0);
  EXPECT_NEAR(row / sum, wanted[1], 1.0);
}
INSTANTIATE_TEST_SUITE_P(From, PatchRasterOf, ::testing::Values(0.0, 75.0, 200.0, 310.0));

TEST(PatchRaster, VideoIsBytesAndPowerIsFloatsWithBlindPixelsAsNoData) {
  const test::TemporaryFolder folder;
  const View view{{37.6, -122.5}, {37.8, -122.3}, 3.3};
  ASSERT_EQ(patch(view, folder.path() / "video.tif").code, 0);
  EXPECT_EQ(GDALGetRasterDataType(Raster(folder.path() / "video.tif").band()), GDT_Byte);
  // The aircraft flies towards the target, so that the whole map is in the blind zone.
  const auto power = folder.path() / "power.tif";
  ASSERT_EQ(patch({view.aircraft, view.target, 3.3, 0.0}, power, {"--pixels", "power", "--force"}).code, 0);
  const Raster raster(power);
  EXPECT_EQ(GDALGetRasterDataType(raster.band()), GDT_Float32);
  int declared = 0;
  EXPECT_TRUE(std::isnan(GDALGetRasterNoDataValue(raster.band(), &declared)));
  EXPECT_EQ(declared, 1);
  EXPECT_TRUE(std::isnan(raster.pixels()[kSize * kSize / 2]));
  EXPECT_FALSE(std::filesystem::exists(power.string() + ".aux.xml"));
}

TEST(PatchRaster, AnOutputThatCannotBeWrittenIsAnErrorOfOneLine) {
  const test::TemporaryFolder folder;
  const View view{{37.6, -122.5}, {37.8, -122.3}, 3.3};
  const auto run = patch(view, folder.path() / "missing" / "map.tif");
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.errors, HasSubstr("missing: expected a folder, found none"));
  EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
  const auto no_georeference = patch(view, folder.path() / "map.png", {"--pixels", "power"});
  EXPECT_EQ(no_georeference.code, 2);
  EXPECT_THAT(no_georeference.errors, HasSubstr("--pixels: expected an --out that ends in .tif"));
}

}  // namespace
}  // namespace yars
