// Rasters with other datums, angle units, prime meridians, axis orders and kinds of height. Expected positions: PROJ
// through GDAL, and the three geocentric shifts of a datum by NIMA TR8350.2 (third edition, appendix B) or IGN.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "lib/geo/quantity.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"

namespace yars::model::terrain {
namespace {

using test::RasterFields;
using test::write_raster;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Place {
  double latitude_deg, longitude_deg;
};

struct Ellipsoid {
  double a_m, inverse_flattening;
};
constexpr Ellipsoid kWgs84{6378137.0, 298.257223563};

struct Datum {
  const char* name;
  const char* system;
  double unit_deg;      // [deg] unit of angles
  double meridian_deg;  // [deg] prime meridian, east of Greenwich
  Ellipsoid ellipsoid;
  double dx_m, dy_m, dz_m;  // geocentric shift to WGS84
  Place about;              // centre of the raster, in the datum
  double ignored_m;         // minimum error if a reader takes the datum for WGS84
};

// Source: NIMA TR8350.2 appendix B.3, B.4, B.6 (means); NTF: IGN, "Transformation entre systemes geodesiques".
const Datum kDatums[] = {
    {"Tokyo", "EPSG:4301", 1.0, 0.0, {6377397.155, 299.1528128}, -148, 507, 685, {35.5, 139.5}, 400},
    {"European1950", "EPSG:4230", 1.0, 0.0, {6378388.0, 297.0}, -87, -98, -121, {45.5, 5.5}, 110},
    {"NorthAmerican1927", "EPSG:4267", 1.0, 0.0, {6378206.4, 294.9786982}, -8, 160, 176, {37.5, -121.5}, 70},
    {"ParisInGrads", "EPSG:4807", 0.9, 2.33722917, {6378249.2, 293.4660213}, -168, -60, 320, {46.0, 3.5}, 40},
    {"LongitudeFirst", "OGC:CRS84", 1.0, 0.0, kWgs84, 0, 0, 0, {46.5, 3.5}, 0}};

double eccentricity_squared(const Ellipsoid& shape) {
  const double f = 1.0 / shape.inverse_flattening;
  return f * (2.0 - f);
}

// Position on WGS84 of a position in the datum: conversion to geocentric axes, shift, and conversion back.
Place shifted(const Datum& datum, Place position) {
  const double e2 = eccentricity_squared(datum.ellipsoid);
  const double latitude = position.latitude_deg * geo::kRadiansPerDegree;
  const double longitude = position.longitude_deg * geo::kRadiansPerDegree;
  const double n = datum.ellipsoid.a_m / std::sqrt(1 - e2 * std::pow(std::sin(latitude), 2));
  const double x = n * std::cos(latitude) * std::cos(longitude) + datum.dx_m;
  const double y = n * std::cos(latitude) * std::sin(longitude) + datum.dy_m;
  const double z = n * (1 - e2) * std::sin(latitude) + datum.dz_m;
  const double e2_84 = eccentricity_squared(kWgs84);
  const double p = std::hypot(x, y);
  double phi = std::atan2(z, p * (1 - e2_84));
  for (int i = 0; i < 10; ++i) {
    const double n_84 = kWgs84.a_m / std::sqrt(1 - e2_84 * std::pow(std::sin(phi), 2));
    phi = std::atan2(z + e2_84 * n_84 * std::sin(phi), p);
  }
  return {phi / geo::kRadiansPerDegree, std::atan2(y, x) / geo::kRadiansPerDegree};
}

double distance_m(Place a, Place b) {
  const double north_m = (a.latitude_deg - b.latitude_deg) * 111'000;
  return std::hypot(north_m, (a.longitude_deg - b.longitude_deg) * 111'000 * std::cos(a.latitude_deg * 0.0174533));
}

class RasterOfDatum : public ::testing::TestWithParam<Datum> {
 protected:
  static constexpr int kPixels = 240;
  static constexpr double kPixel_deg = 0.2 / kPixels;

  // Raster of 0.2 x 0.2 degrees about the datum's `about`, in the datum's unit and prime meridian.
  RasterFields fields() const {
    const Datum& datum = GetParam();
    const double pixel = kPixel_deg / datum.unit_deg;
    const double west = (datum.about.longitude_deg - datum.meridian_deg - 0.1) / datum.unit_deg;
    const double north = (datum.about.latitude_deg + 0.1) / datum.unit_deg;
    RasterFields fields{kPixels, kPixels, {west, pixel, 0, north, 0, -pixel}};
    fields.system = datum.system;
    fields.type = GDT_Float32;
    return fields;
  }

  // Position that the rasters encode at a WGS84 position. Their heights rise by 30,000 m per degree, to the north in
  // one raster and to the east in the other.
  Place read_place(const std::filesystem::path& north, const std::filesystem::path& east, Place position) {
    const CellCorner corner = cell_containing({position.latitude_deg, position.longitude_deg});
    const auto height_m = [&](const std::filesystem::path& path) {
      const auto key = std::pair(path, slot_of(corner));
      auto found = read_.find(key);
      if (found == read_.end()) found = read_.emplace(key, read_cell({path, CellFormat::raster}, corner)).first;
      const auto& reading = found->second;
      EXPECT_TRUE(reading.has_value()) << reading.error().message();
      return reading ? interpolate(reading->cell, position.latitude_deg - corner.south_deg,
                                   position.longitude_deg - corner.west_deg)
                           .elevation_m
                     : 0.0;
    };
    const Place about = GetParam().about;
    return {about.latitude_deg + (height_m(north) - 4000) / 30'000,
            about.longitude_deg + (height_m(east) - 4000) / 30'000};
  }

 private:
  std::map<std::pair<std::filesystem::path, std::size_t>, decltype(read_cell({}, {}))> read_;  // cells, read once
};

TEST_P(RasterOfDatum, HasItsHeightsAtTheWgs84PositionsOfProj) {
  const Datum& datum = GetParam();
  const test::TemporaryFolder folder;
  const RasterFields raster = fields();
  const test::Transform proj = test::transform_between(datum.system, "EPSG:4326");
  ASSERT_NE(proj, nullptr);
  const auto plane = [&](bool north) {
    return [&, north](int row, int column) {
      double x = raster.geotransform[0] + (column + 0.5) * raster.geotransform[1];
      double y = raster.geotransform[3] + (row + 0.5) * raster.geotransform[5];
      OCTTransform(proj.get(), 1, &x, &y, nullptr);
      return 4000 + 30'000 * (north ? y - datum.about.latitude_deg : x - datum.about.longitude_deg);
    };
  };
  write_raster(folder.path() / "north.tif", raster, plane(true));
  write_raster(folder.path() / "east.tif", raster, plane(false));
  for (const Place offset : {Place{0, 0}, Place{0.08, -0.08}, Place{-0.07, 0.06}}) {
    const Place position{datum.about.latitude_deg + offset.latitude_deg,
                         datum.about.longitude_deg + offset.longitude_deg};
    // Heights are rounded to 0.1 m, which is 0.2 m of position. PROJ may choose between equally accurate
    // transformations.
    EXPECT_LT(distance_m(read_place(folder.path() / "north.tif", folder.path() / "east.tif", position), position), 1.0);
  }
}

TEST_P(RasterOfDatum, HasItsHeightsAtThePositionsOfTheGeocentricShift) {
  const Datum& datum = GetParam();
  const test::TemporaryFolder folder;
  const auto plane = [&](bool north) {
    return [&, north](int row, int column) {
      const Place in_datum{datum.about.latitude_deg + 0.1 - (row + 0.5) * kPixel_deg,
                           datum.about.longitude_deg - 0.1 + (column + 0.5) * kPixel_deg};
      const Place on_wgs84 = shifted(datum, in_datum);
      return 4000 + 30'000 * (north ? on_wgs84.latitude_deg - datum.about.latitude_deg
                                    : on_wgs84.longitude_deg - datum.about.longitude_deg);
    };
  };
  write_raster(folder.path() / "north.tif", fields(), plane(true));
  write_raster(folder.path() / "east.tif", fields(), plane(false));
  // Mean shifts of a continent have errors of 5 to 20 m (TR8350.2).
  EXPECT_LT(distance_m(read_place(folder.path() / "north.tif", folder.path() / "east.tif", datum.about), datum.about),
            25.0);
  EXPECT_GE(distance_m(shifted(datum, datum.about), datum.about), datum.ignored_m) << "shift of the datum";
}

INSTANTIATE_TEST_SUITE_P(Datum, RasterOfDatum, ::testing::ValuesIn(kDatums),
                         [](const auto& each) { return std::string(each.param.name); });

RasterFields constant_fields(const char* system, Place about) {
  const double pixel = 0.2 / 60;
  RasterFields fields{60, 60, {about.longitude_deg - 0.1, pixel, 0, about.latitude_deg + 0.1, 0, -pixel}};
  fields.system = system;
  fields.type = GDT_Float32;
  return fields;
}

double height_at(const CellReading& reading, Place position) {
  const CellCorner corner = reading.cell.corner();
  return interpolate(reading.cell, position.latitude_deg - corner.south_deg, position.longitude_deg - corner.west_deg)
      .elevation_m;
}

// Geoid heights: NGA's test points for the EGM96 interpolation program (OUTINTPT.DAT).
TEST(RasterHeights, AboveTheEllipsoidAreConvertedToMeanSeaLevelOrRefused) {
  struct Golden {
    Place position;
    double geoid_m;
  };
  for (const Golden& golden :
       {Golden{{38.6281550, -90.2208450}, -31.628}, Golden{{-14.6212170, -54.9788860}, -2.969},
        Golden{{46.8743190, 102.4487290}, -43.575}, Golden{{-23.6174460, 133.8747120}, 15.871}}) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "ellipsoidal.tif";
    write_raster(path, constant_fields("EPSG:4979", golden.position), [](int, int) { return 500.0; });
    const auto reading = read_cell({path, CellFormat::raster},
                                   cell_containing({golden.position.latitude_deg, golden.position.longitude_deg}));
    if (!reading) {
      EXPECT_THAT(reading.error().message(), AllOf(HasSubstr("ellipsoid"), HasSubstr("proj-data")));
      continue;
    }
    EXPECT_NEAR(height_at(*reading, golden.position), 500.0 - golden.geoid_m, 0.5);
    EXPECT_THAT(reading->file_notes, ElementsAre(AllOf(HasSubstr("ellipsoid"), HasSubstr("EGM96"))));
  }
}

TEST(RasterHeights, InFeetAndAsDepthsAreConvertedToMetresAboveMeanSeaLevel) {
  constexpr Place kPlace{38.5, -90.5};
  struct Vertical {
    const char* system;
    double number, height_m;
  };
  // NAVD88 in metres and in US survey feet (EPSG:5703, 6360), depth below mean sea level (EPSG:5715).
  for (const Vertical& vertical :
       {Vertical{"EPSG:4326+5703", 100.0, 100.0}, Vertical{"EPSG:4326+6360", 1000.0, 304.8006},
        Vertical{"EPSG:4326+5715", 50.0, -50.0}}) {
    const test::TemporaryFolder folder;
    write_raster(folder.path() / "a.tif", constant_fields(vertical.system, kPlace),
                 [&](int, int) { return vertical.number; });
    const auto reading = read_cell({folder.path() / "a.tif", CellFormat::raster}, {38, -91});
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_NEAR(height_at(*reading, kPlace), vertical.height_m, 0.06) << vertical.system;
  }
}

TEST(RasterDatum, AnInaccurateTransformationGivesOneWarningPerRaster) {
  const test::TemporaryFolder folder;
  // An unknown datum. The raster covers four cells.
  RasterFields fields{120, 120, {9.5, 1.0 / 120, 0, 51.5, 0, -1.0 / 120}};
  fields.system =
      "GEOGCRS[\"nowhere\",DATUM[\"Nobody's datum\",ELLIPSOID[\"Clarke 1866\",6378206.4,294.978698213898]],"
      "CS[ellipsoidal,2],AXIS[\"latitude\",north],AXIS[\"longitude\",east],"
      "ANGLEUNIT[\"degree\",0.0174532925199433]]";
  write_raster(folder.path() / "nobody.tif", fields, [](int row, int) { return 100 + row; });
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  (*store)->prepare({{51.0, 10.0}, 50e3});
  EXPECT_THAT((*store)->take_notes(), ElementsAre(AllOf(HasSubstr("nobody.tif"), HasSubstr("ballpark"))));
  EXPECT_THAT((*store)->take_problems(), IsEmpty()) << "a note about accuracy is no damage";
}

TEST(RasterDatum, Wgs84IsReadWithoutWarnings) {
  const test::TemporaryFolder folder;
  for (const char* system : {"EPSG:4326", "EPSG:32631", "EPSG:4326+5773"}) {
    RasterFields fields = constant_fields(system, {46.5, 3.5});
    if (std::string_view(system) == "EPSG:32631") fields.geotransform = {538'000, 300, 0, 5'160'000, 0, -300};
    write_raster(folder.path() / "a.tif", fields, [](int row, int) { return 100 + row; });
    const auto reading = read_cell({folder.path() / "a.tif", CellFormat::raster}, {46, 3});
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_THAT(reading->file_notes, IsEmpty()) << system;
    EXPECT_LT(reading->cell.voids(), reading->cell.post_count());
  }
}

}  // namespace
}  // namespace yars::model::terrain
