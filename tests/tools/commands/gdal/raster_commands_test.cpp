// `yars terrain` over rasters: datums of DTED files under other names, heights above the ellipsoid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "model/terrain/formats/dted.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RasterCommands, ADtedFileOfAnotherDatumIsRefusedUnderAnotherName) {
  const test::TemporaryFolder folder;
  std::vector<std::byte> bytes = model::terrain::dted_bytes(test::rough_cell({36, -122}, 121, 121, 1), 0);
  const std::string datum = "ELL";
  for (std::size_t i = 0; i < datum.size(); ++i)
    bytes[model::terrain::dted::kUserHeaderBytes + model::terrain::dted::kVerticalDatumAt + i] =
        static_cast<std::byte>(datum[i]);
  folder.write("mytile.dt0", bytes);
  folder.write("tree/a.img", bytes);
  for (const char* input : {"mytile.dt0", "tree"}) {
    const auto converted = endtoend::run_program(
        {"yars", "terrain", "convert", "--in", folder.path() / input, "--out", folder.path() / "out"});
    EXPECT_EQ(converted.code, 1);
    EXPECT_THAT(converted.errors, HasSubstr("found 'ELL'"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
  }
}

TEST(RasterCommands, InfoOfHeightsAboveTheEllipsoidPrintsHeightsAboveMeanSeaLevel) {
  const test::TemporaryFolder folder;
  // The geoid is 100 to 107 m below the ellipsoid south of India.
  test::RasterFields fields = test::degree_raster(4, 78, 61);
  fields.system = "EPSG:4979";
  fields.type = GDT_Float32;
  test::write_raster(folder.path() / "a.tif", fields, [](int, int) { return 500.0; });
  const auto info = endtoend::run_program({"yars", "terrain", "info", folder.path().string()});
  // Without proj-data the raster is refused.
  EXPECT_THAT(info.output + info.errors, AnyOf(HasSubstr(", 60"), HasSubstr("proj-data"))) << "600 to 609 m";
  EXPECT_THAT(info.output, Not(AnyOf(HasSubstr(" 500 "), HasSubstr("500 m"))));
}

// A change of datum is said, and nothing is left out.
TEST(RasterCommands, ANoteOfAccuracyIsNoDamage) {
  for (const char* system : {"EPSG:4269", "EPSG:4979"}) {
    const test::TemporaryFolder folder;
    test::RasterFields fields = test::degree_raster(45, -122, 61);
    fields.system = system;
    fields.type = GDT_Float32;
    test::write_raster(folder.path() / "a.tif", fields, [](int, int) { return 500.0; });
    const auto profile = endtoend::run_program({"yars", "terrain", "profile", "--terrain", folder.path(), "--from",
                                                "45.5", "-121.5", "--to", "45.5", "-121.4"});
    if (profile.errors.find("proj-data") != std::string::npos) continue;  // without it heights are refused
    EXPECT_EQ(profile.code, 0) << system << ": " << profile.errors;
    EXPECT_THAT(profile.errors, Not(HasSubstr("problem"))) << system;
    // A system that has all grids needs no note about NAD83.
    if (std::string(system) == "EPSG:4979") {
      EXPECT_THAT(profile.errors, HasSubstr("note: "));
    }
  }
}

TEST(RasterCommands, InfoNamesTheOtherRastersOfACell) {
  const test::TemporaryFolder folder;
  for (const auto& [name, west_deg] : {std::pair("west.tif", 5.0), {"east.tif", 5.5}})
    test::write_raster(folder.path() / name, {60, 120, {west_deg, 1.0 / 120, 0, 46, 0, -1.0 / 120}},
                       [](int, int) { return 500; });
  const auto info = endtoend::run_program({"yars", "terrain", "info", folder.path(), "--json"});
  EXPECT_EQ(info.code, 0) << info.errors;
  const auto found = nlohmann::json::parse(info.output);
  EXPECT_EQ(found["cells"].size(), 1U);
  EXPECT_EQ(found["cells"][0]["voids"], 0);
  EXPECT_EQ(found["cells"][0]["others"].size(), 1U);
  EXPECT_TRUE(found["problems"].empty());
}

}  // namespace
}  // namespace yars
