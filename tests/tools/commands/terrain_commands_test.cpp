// `yars terrain info`, `image`, `profile` and `dump`, `yars scan` and `yars patch`, `yars scene image`: exit codes, and
// messages about damage, positions without a cell and bad options.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/terrain/formats/dted.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/lib/imageio/read_png.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars {
namespace {

namespace terrain = model::terrain;
using endtoend::Finished;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class TerrainCommands : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(terrain::write_dted(tree(), test::rough_cell({36, -122}, 121, 121, 1), 0)); }
  std::filesystem::path tree() const { return folder_.path() / "tree"; }
  std::filesystem::path cell() const { return tree() / "w122/n36.dt0"; }
  std::string picture() const { return folder_.path() / "a.png"; }
  Finished run_terrain(const std::string& command, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"yars", "terrain", command, "--terrain", tree()};
    words.insert(words.end(), more.begin(), more.end());
    return endtoend::run_program(words);
  }
  void damage(std::size_t at) const {
    std::fstream file(cell(), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(at));
    file.put('\x01');
  }

  test::TemporaryFolder folder_;
};

TEST_F(TerrainCommands, InfoOfWholeCellsEndsWith0) {
  const Finished info = run_terrain("info");
  EXPECT_EQ(info.code, 0) << info.errors;
  EXPECT_EQ(info.errors, "");
  EXPECT_THAT(info.output, HasSubstr("1 cell, latitude 36 to 37, longitude -122 to -121"));
}

// Output to a terminal replaces control characters by visible text. The control characters of the progress line are
// excepted.
TEST_F(TerrainCommands, ProgressIsOneLineOfTheTerminalThatIsRedrawn) {
  const std::string command =
      "TERM=xterm '" YARS_BIN_DIR "/yars' terrain info --terrain " + tree().string() + " >/dev/null";
  const Finished shown = endtoend::run_tool({"script", "-qec", command, "/dev/null"});
  EXPECT_EQ(shown.code, 0) << shown.errors;
  EXPECT_THAT(shown.output, HasSubstr("\r\033[K1 of 1 cells"));
  EXPECT_THAT(shown.output, Not(HasSubstr("\\x1b")));
}

TEST_F(TerrainCommands, InfoOfDamagedCellsEndsWith1) {
  damage(3428 + 40);
  Finished info = run_terrain("info");
  EXPECT_EQ(info.code, 1);
  EXPECT_THAT(info.output, HasSubstr("wrong checksum"));
  std::filesystem::resize_file(cell(), 5000);
  info = run_terrain("info");
  EXPECT_EQ(info.code, 1);
  EXPECT_THAT(info.output, HasSubstr("truncated"));
  EXPECT_THAT(info.output, Not(HasSubstr("0 cells")));
  EXPECT_THAT(info.errors, HasSubstr("terrain info"));
}

TEST_F(TerrainCommands, InfoOfACellWithOnlyVoidsHasNoHeights) {
  const auto all_void = test::cell_of({36, -122}, 121, 121, [](int, int) { return int{terrain::kVoidPost}; });
  ASSERT_TRUE(terrain::write_dted(tree(), all_void, 0));
  const Finished info = run_terrain("info");
  EXPECT_EQ(info.code, 0);
  EXPECT_THAT(info.output,
              AllOf(HasSubstr("   void    void    14641"), HasSubstr("no heights, 14641 of 14641 posts void")));
  EXPECT_THAT(info.output, AllOf(Not(HasSubstr("32767")), Not(HasSubstr("inf"))));
}

TEST_F(TerrainCommands, AnImageOfDamagedCellsOrWithoutCellsEndsWith1) {
  EXPECT_EQ(run_terrain("image", {"--out", picture(), "--width", "64"}).code, 0);
  const Finished elsewhere = run_terrain("image", {"--out", picture(), "--width", "64", "--south", "36", "--north",
                                                   "37", "--west", "121", "--east", "122"});
  EXPECT_EQ(elsewhere.code, 1);
  EXPECT_THAT(elsewhere.errors, HasSubstr("the folder covers latitude 36 to 37, longitude -122 to -121"));
  std::filesystem::resize_file(cell(), 5000);
  EXPECT_EQ(run_terrain("image", {"--out", picture(), "--width", "64"}).code, 1);
  const Finished wrong = run_terrain("image", {"--out", folder_.path() / "a.jpg"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("expected a name that ends in .png"));
}

TEST_F(TerrainCommands, AProfileOutsideTheDataReportsTheCoverage) {
  EXPECT_EQ(run_terrain("profile", {"--from", "36.2", "-121.8", "--to", "36.4", "-121.6"}).code, 0);
  const Finished outside = run_terrain("profile", {"--from", "36.2", "121.8", "--to", "36.4", "121.6"});
  EXPECT_EQ(outside.code, 1);
  EXPECT_THAT(outside.errors, HasSubstr("the folder covers latitude 36 to 37, longitude -122 to -121"));
  const Finished partly =
      run_terrain("profile", {"--from", "36.5", "-121.5", "--to", "36.5", "-120.5", "--step", "1000"});
  EXPECT_EQ(partly.code, 0) << partly.errors;
  EXPECT_THAT(partly.errors, AllOf(HasSubstr("none at"), HasSubstr("count as sea")));
  std::filesystem::resize_file(cell(), 5000);
  EXPECT_EQ(run_terrain("profile", {"--from", "36.2", "-121.8", "--to", "36.4", "-121.6"}).code, 1);
}

// Two's complement is how some producers write DTED. Nothing is left out.
TEST_F(TerrainCommands, ANoteAboutTheHeightsIsNoDamage) {
  test::DtedFile file = test::level_dted(36, -122, 5);
  file.columns[1].words[1] = 0xFFF6;  // -10 m; in sign-magnitude it would be -32758 m
  folder_.write("tree/w122/n36.dt0", file.bytes());
  const std::vector<std::string> ends{"--from", "36.2", "-121.8", "--to", "36.4", "-121.6", "--step", "10000"};
  const Finished profile = run_terrain("profile", ends);
  EXPECT_EQ(profile.code, 0) << profile.errors;
  EXPECT_THAT(profile.errors, AllOf(HasSubstr("note: "), HasSubstr("two's complement"), Not(HasSubstr("problem"))));
  std::vector<std::string> in_json = ends;
  in_json.emplace_back("--json");
  const Finished json = run_terrain("profile", in_json);
  EXPECT_EQ(json.code, 0) << json.errors;
  const auto found = nlohmann::json::parse(json.output);
  EXPECT_EQ(found["samples"].size(), 4U);
  EXPECT_TRUE(found["problems"].empty());
  ASSERT_EQ(found["notes"].size(), 1U);
  for (const char* command : {"info", "dump"}) {
    const Finished done = run_terrain(command, std::string(command) == "dump"
                                                   ? std::vector<std::string>{"--south", "36", "--west", "-122"}
                                                   : std::vector<std::string>{});
    EXPECT_EQ(done.code, 0) << done.errors;
    EXPECT_THAT(done.output + done.errors, AllOf(HasSubstr("note: "), Not(HasSubstr("problem"))));
  }
}

TEST_F(TerrainCommands, ADumpOfAMissingCellReportsTheCoverage) {
  const Finished dump = run_terrain("dump", {"--south", "36", "--west", "121"});
  EXPECT_EQ(dump.code, 1);
  EXPECT_THAT(dump.errors, HasSubstr("the folder covers latitude 36 to 37, longitude -122 to -121"));
}

TEST_F(TerrainCommands, AScanAndAPatchOutsideTheDataReportTheCoverage) {
  const Finished scan = endtoend::run_program({"yars", "scan", "--terrain", tree(), "--lat", "36.5", "--lon", "121.5",
                                               "--range-nm", "10", "--repeat", "1", "--samples", "32"});
  EXPECT_THAT(scan.errors, HasSubstr("the folder covers latitude 36 to 37, longitude -122 to -121"));
  const Finished patch = endtoend::run_program(
      {"yars",         "patch", "--terrain",    tree(),  "--lat",       "36.5", "--lon",  "121.2", "--heading", "50",
       "--target-lat", "36.6",  "--target-lon", "121.5", "--window-nm", "1.3",  "--size", "32",    "--repeat",  "1"});
  EXPECT_THAT(patch.errors, HasSubstr("the folder covers latitude 36 to 37, longitude -122 to -121"));
  const Finished here = endtoend::run_program({"yars", "scan", "--terrain", tree(), "--lat", "36.5", "--lon", "-121.5",
                                               "--range-nm", "10", "--repeat", "1", "--samples", "32"});
  EXPECT_THAT(here.errors, Not(HasSubstr("the folder covers")));
}

TEST_F(TerrainCommands, EveryOutputOptionChecksTheEndingOfTheName) {
  const auto refused = [&](std::vector<std::string> command, const std::string& ending) {
    const Finished done = endtoend::run_program(command);
    EXPECT_EQ(done.code, 2) << done.errors;
    EXPECT_THAT(done.errors, HasSubstr("a name that ends in " + ending));
  };
  refused({"yars", "scan", "--out", "a.jpg"}, ".png");
  refused({"yars", "patch", "--out", "a.jpg"}, ".png");
  refused({"yars", "trade", "--out", "a.png"}, ".json");
  refused({"yars", "trade", "--csv", "a.txt"}, ".csv");
  refused({"yars", "scene", "generate", "--origin", "37,-122", "--out", "a.osg"}, ".flt");
  refused({"yars", "config", "convert", "--out", "a.txt"}, ".guf");
  std::ofstream(folder_.path() / "a.flt") << "x";
  refused({"yars", "scene", "image", folder_.path() / "a.flt", "--out", "a.jpg"}, ".png");
}

TEST_F(TerrainCommands, SceneImageLimitsSideAndEdgesOfItsWindow) {
  const std::string scene = folder_.path() / "a.flt";
  ASSERT_EQ(endtoend::run_program({"yars", "scene", "generate", "--origin", "37,-122", "--out", scene}).code, 0);
  const auto draw = [&](const std::string& west, const std::string& side) {
    return endtoend::run_program(
        {"yars", "scene", "image", scene, "--out", picture(), "--width", "64", "--window", west, "0", side});
  };
  for (const char* side : {"1e-6", "0", "-5", "1e300"}) {
    const Finished done = draw("0", side);
    EXPECT_EQ(done.code, 2) << done.errors;
    EXPECT_THAT(done.errors, AllOf(HasSubstr("--window: expected a side of 0.1 to 1e+06 m, found "), HasSubstr("; ")));
  }
  EXPECT_THAT(draw("1e300", "100").errors, HasSubstr("--window: expected edges within 1e+07 m of the origin"));
  EXPECT_EQ(draw("9e6", "0.1").code, 0) << "a window beside the scene is allowed";
  EXPECT_EQ(draw("0", "0.1").code, 0);
}

// Regions that are far narrower than high, and a region far smaller than a cell.
TEST_F(TerrainCommands, AnImageOfAVeryNarrowOrSmallRegionIsDrawn) {
  const auto image = [&](const std::string& north, const std::string& east) {
    return run_terrain("image", {"--out", picture(), "--width", "16", "--south", "36.5", "--north", north, "--west",
                                 "-121.5", "--east", east});
  };
  for (const char* east : {"-121.4999999999", "-121.49999999999", "-121.4999999999999"}) {
    const Finished done = image("36.6", east);
    EXPECT_EQ(done.code, 0) << done.errors;
    const auto map = test::read_png(picture());
    ASSERT_TRUE(map) << map.error().message();
    EXPECT_EQ(map->height, 16384) << "the maximum height, " << east;
  }
  const Finished small = image("36.5000000000001", "-121.4999999999999");
  EXPECT_EQ(small.code, 0) << small.errors;
}

}  // namespace
}  // namespace yars
