// `yars terrain cover`: culture beside a copy of the elevation, as scans see it; faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"

namespace yars {
namespace {

namespace terrain = model::terrain;
using ::testing::HasSubstr;

constexpr terrain::CellCorner kCorner{37, -123};

// Level ground at sea level, where elevation alone has sea, and a raster whose western half is land.
class CoverCommand : public ::testing::Test {
 protected:
  CoverCommand() {
    const std::vector<std::int16_t> level(121 * 121, 0);
    folder_.write("in/w123/n37.dt0", terrain::dted_bytes(terrain::Cell(kCorner, 121, 121, level), 0));
    const double step = 1.0 / 1200;
    test::RasterFields fields{1200, 1200, {-123.0, step, 0, 38.0, 0, -step}};
    fields.type = GDT_Byte;
    test::write_raster(raster(), fields, [](int, int column) { return column < 600 ? 50 : 80; });
  }
  std::string raster() const { return (folder_.path() / "cover.tif").string(); }
  std::string in() const { return (folder_.path() / "in").string(); }
  std::string out() const { return (folder_.path() / "out").string(); }
  endtoend::Finished cover(std::vector<std::string> more) const {
    std::vector<std::string> words{"yars", "terrain", "cover", "--terrain", in(), "--out", out()};
    words.insert(words.end(), more.begin(), more.end());
    return endtoend::run_program(words);
  }

  test::TemporaryFolder folder_;
};

TEST_F(CoverCommand, TheCoverDecidesWhatIsSea) {
  const auto done = cover({"--from", raster(), "--legend", "worldcover", "--json"});
  ASSERT_EQ(done.code, 0) << done.errors;
  const auto facts = nlohmann::json::parse(done.output);
  EXPECT_EQ(facts["cells"], 1);
  EXPECT_EQ(facts["posts"]["built-up"].get<int>() + facts["posts"]["permanent water"].get<int>(), 1201 * 1201);
  auto store = terrain::open_terrain({out(), false});
  ASSERT_TRUE(store.has_value());
  const auto view = (*store)->prepare({{37.5, -122.5}, 60e3});
  const auto land = view->surface_at({37.5, -122.8}), sea = view->surface_at({37.5, -122.2});
  EXPECT_EQ(land.water, 0.0) << "at 0 m, and built up";
  EXPECT_EQ(land.material, static_cast<int>(terrain::Material::composition));
  EXPECT_EQ(sea.water, 1.0);
}

TEST_F(CoverCommand, ARunThatWasCutOffGoesOn) {
  const std::string own = (folder_.path() / "own.csv").string(), culture = out() + "/w123/n37.smc.png";
  std::ofstream(own) << "class,name,material,source\n80,water,water,\n50,town,stone,\n";
  const auto kept = [&] {
    const auto done = cover({"--from", raster(), "--legend", own, "--json"});
    EXPECT_EQ(done.code, 0) << done.errors;
    return nlohmann::json::parse(done.output)["kept"].get<int>();
  };
  EXPECT_EQ(kept(), 0);
  const auto made = std::filesystem::last_write_time(culture);
  EXPECT_EQ(kept(), 1);
  EXPECT_EQ(std::filesystem::last_write_time(culture), made);
  std::filesystem::remove(culture);
  EXPECT_EQ(kept(), 0) << "the culture that was lost is made again";
  std::ofstream(own, std::ios::app) << "1,sand,sand,\n";
  EXPECT_EQ(kept(), 0) << "another legend";
}

TEST_F(CoverCommand, AClassWithoutALineIsNamed) {
  std::ofstream(folder_.path() / "own.csv") << "class,name,material,source\n80,water,water,\n";
  const auto done = cover({"--from", raster(), "--legend", (folder_.path() / "own.csv").string()});
  EXPECT_EQ(done.code, 1);
  EXPECT_THAT(done.errors, HasSubstr("expected a line of the legend for each class, found none for 50 ("));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/w123/n37.smc.png")) << "the other classes are written";
  EXPECT_EQ(cover({"--from", raster(), "--legend", (folder_.path() / "own.csv").string()}).code, 1) << "and again";
}

TEST_F(CoverCommand, FaultsAreSaidBeforeAnythingIsWritten) {
  EXPECT_THAT(cover({"--from", raster(), "--legend", "atlas"}).errors, HasSubstr("atlas.csv"));
  EXPECT_THAT(cover({"--from", in() + "/w123/n37.dt0", "--legend", "nlcd", "--posts", "100"}).errors,
              HasSubstr("--posts"));
  const auto same = endtoend::run_program(
      {"yars", "terrain", "cover", "--terrain", in(), "--out", in(), "--from", raster(), "--legend", "worldcover"});
  EXPECT_EQ(same.code, 2);
  EXPECT_THAT(same.errors, HasSubstr("the input is never overwritten"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
}

TEST_F(CoverCommand, ARasterElsewhereIsAnError) {
  test::RasterFields fields{10, 10, {10.0, 0.1, 0, 11.0, 0, -0.1}};
  fields.type = GDT_Byte;
  test::write_raster(folder_.path() / "far.tif", fields, [](int, int) { return 10; });
  const auto done = cover({"--from", (folder_.path() / "far.tif").string(), "--legend", "worldcover"});
  EXPECT_EQ(done.code, 1);
  EXPECT_THAT(done.errors, HasSubstr("expected rasters over a cell of"));
}

}  // namespace
}  // namespace yars
