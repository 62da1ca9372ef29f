// `yars terrain reduce`, `convert` and `pack`: posts, peaks and culture of the output, progress, and errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars {
namespace {

namespace terrain = model::terrain;
using terrain::Cell;
using terrain::CellCorner;
using terrain::CellReading;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr CellCorner kWest{36, -122};
constexpr CellCorner kEast{36, -121};

endtoend::Finished run(const std::string& command, const std::filesystem::path& in, const std::filesystem::path& out,
                       const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"yars", "terrain", command, "--in", in.string(), "--out", out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return endtoend::run_program(words);
}

// Input: two adjacent cells of DTED level 0, with seas, cliffs and voids.
class TerrainBatch : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(terrain::write_dted(in(), cell_at(kWest), 0));
    ASSERT_TRUE(terrain::write_dted(in(), cell_at(kEast), 0));
  }

  static Cell cell_at(CellCorner corner) { return test::rough_cell(corner, 121, 121, corner == kWest ? 1 : 2); }
  std::filesystem::path in() const { return folder_.path() / "in"; }
  std::filesystem::path out() const { return folder_.path() / "out"; }

  static CellReading read(const std::filesystem::path& file, CellCorner corner, int reduction = 0) {
    const auto index = terrain::index_file(file.string());
    EXPECT_TRUE(index.has_value()) << index.error().message();
    auto reading = terrain::read_cell(index->begin()->second, corner, reduction);
    EXPECT_TRUE(reading.has_value()) << file;
    return *reading;
  }

  // Expects an exit code, and `words` on standard error.
  static void expect_refused(const endtoend::Finished& run, int code, const std::vector<std::string>& words) {
    EXPECT_EQ(run.code, code) << run.errors;
    for (const std::string& word : words) EXPECT_THAT(run.errors, HasSubstr(word));
  }

  test::TemporaryFolder folder_;
};

TEST_F(TerrainBatch, ConversionToHgtPackAndDtedInTurnKeepsPostsAndVoids) {
  // HGT has no spacing of DTED level 0. The conversions begin with level 1.
  const std::filesystem::path start = folder_.path() / "level1";
  ASSERT_EQ(run("convert", in(), start, {"--level", "1"}).code, 0);
  const Cell cell = read(start / "w122" / "n36.dt1", kWest).cell;
  ASSERT_EQ(cell.rows(), 1201);
  ASSERT_GT(cell.voids(), 0U);
  ASSERT_GT(cell.sea_posts(), 0U);
  const std::filesystem::path hgt = folder_.path() / "hgt", packed = folder_.path() / "packed";
  ASSERT_EQ(run("convert", start, hgt, {"--to", "hgt"}).code, 0);
  ASSERT_EQ(run("convert", hgt, packed, {"--to", "jp2"}).code, 0);
  ASSERT_EQ(run("convert", packed, out(), {"--to", "dted"}).code, 0);
  EXPECT_TRUE(test::same_posts(read(hgt / "N36W122.hgt", kWest).cell, cell));
  EXPECT_TRUE(test::same_posts(read(packed / "w122" / "n36.jp2", kWest).cell, cell));
  EXPECT_TRUE(test::same_posts(read(out() / "w122" / "n36.dt1", kWest).cell, cell));
}

TEST_F(TerrainBatch, ProgressOnATerminalNamesEachCellWrittenAndTheirNumber) {
  const std::string command =
      "'" YARS_BIN_DIR "/yars' terrain convert --in " + in().string() + " --out " + out().string() + " >/dev/null";
  const auto shown = endtoend::run_tool({"script", "-qec", command, "/dev/null"});
  ASSERT_EQ(shown.code, 0) << shown.errors;
  EXPECT_THAT(shown.output, HasSubstr("1/2"));
  EXPECT_THAT(shown.output, HasSubstr("2/2"));
  EXPECT_THAT(shown.output, HasSubstr("n36.dt0"));
}

TEST_F(TerrainBatch, WithoutATerminalOnlyTheTotalsArePrinted) {
  const auto converted = run("convert", in(), out());
  ASSERT_EQ(converted.code, 0) << converted.errors;
  EXPECT_THAT(converted.output, testing::StartsWith("2 cells, "));
  EXPECT_THAT(converted.output + converted.errors, testing::Not(HasSubstr("1/2")));
  EXPECT_THAT(converted.errors, testing::AnyOf("", testing::StartsWith("note: ")));
}

TEST_F(TerrainBatch, AReducedCellHasTheMeans) {
  ASSERT_EQ(run("reduce", in(), out(), {"--reduction", "2"}).code, 0);
  const Cell found = read(out() / "w122" / "n36.jp2", kWest).cell;
  const terrain::ReducedCell expected = terrain::reduce(cell_at(kWest), 2);
  EXPECT_EQ(found.rows(), 31);
  EXPECT_TRUE(test::same_posts(found, expected.means));
}

TEST_F(TerrainBatch, AReducedCellReadWithAFurtherReductionHasPeaks) {
  ASSERT_EQ(run("reduce", in(), out(), {"--reduction", "1"}).code, 0);
  const std::filesystem::path file = out() / "w122" / "n36.jp2";
  const Cell half = read(file, kWest).cell;
  const CellReading quarter = read(file, kWest, 1);
  ASSERT_TRUE(quarter.peaks.has_value());
  const terrain::ReducedCell expected = terrain::reduce(half, 1);
  EXPECT_TRUE(test::same_posts(*quarter.peaks, expected.peaks));
}

TEST_F(TerrainBatch, APackHasTheSamePostsAndReducedTheSameMeansAndPeaks) {
  const auto packed = run("pack", in(), out());
  ASSERT_EQ(packed.code, 0) << packed.errors;
  for (const CellCorner corner : {kWest, kEast}) {
    const std::filesystem::path file = out() / (corner == kWest ? "w122" : "w121") / "n36.jp2";
    const Cell cell = cell_at(corner);
    EXPECT_TRUE(test::same_posts(read(file, corner).cell, cell));
    const CellReading reduced = read(file, corner, 2);
    const terrain::ReducedCell expected = terrain::reduce(cell, 2);
    ASSERT_EQ(reduced.cell.rows(), 31);
    ASSERT_TRUE(reduced.peaks.has_value());
    EXPECT_TRUE(test::same_posts(*reduced.peaks, expected.peaks));
    EXPECT_EQ(reduced.cell.voids(), expected.means.voids());
    EXPECT_EQ(reduced.cell.sea_posts(), expected.means.sea_posts());
  }
}

// Culture whose codes depend on row, column and cell, so that a shift is detected.
terrain::Culture culture_at(CellCorner corner, int posts) {
  std::vector<std::uint8_t> codes;
  for (int row = 0; row < posts; ++row)
    for (int column = 0; column < posts; ++column)
      codes.push_back(static_cast<std::uint8_t>((row * 3 + column + (corner == kWest ? 0 : 5)) % 14));
  return {corner, posts, posts, codes};
}

TEST_F(TerrainBatch, CultureIsWrittenBesideItsCell) {
  const terrain::Culture culture = culture_at(kWest, 241);
  ASSERT_TRUE(terrain::write_culture(in() / "w122/n36.smc.png", culture));
  struct Case {
    std::string command, elevation, culture;
    std::vector<std::string> more;
    int posts;
  };
  for (const Case& each : {Case{"convert", "w122/n36.dt0", "w122/n36.smc.png", {}, 241},
                           Case{"convert", "N36W122.hgt", "N36W122.smc.png", {"--to", "hgt"}, 241},
                           Case{"convert", "w122/n36.jp2", "w122/n36.smc.png", {"--to", "jp2"}, 241},
                           Case{"pack", "w122/n36.jp2", "w122/n36.smc.png", {}, 241},
                           Case{"reduce", "w122/n36.jp2", "w122/n36.smc.png", {"--reduction", "2"}, 31},
                           Case{"reduce", "w122/n36.dt0", "w122/n36.smc.png", {"--level", "0"}, 121}}) {
    const auto tree = folder_.path() / (each.command + std::to_string(each.posts) + each.elevation.substr(0, 3));
    const auto done = run(each.command, in(), tree, each.more);
    ASSERT_EQ(done.code, 0) << done.errors;
    ASSERT_TRUE(std::filesystem::exists(tree / each.elevation));
    const auto found = terrain::read_culture(tree / each.culture, kWest);
    ASSERT_TRUE(found.has_value()) << each.command << ": " << found.error().message();
    ASSERT_EQ(found->rows(), each.posts) << each.command;
    const int step = 240 / (each.posts - 1);
    for (int row = 0; row < each.posts; ++row)
      for (int column = 0; column < each.posts; ++column)
        ASSERT_EQ(found->post(row, column).material, culture.post(row * step, column * step).material) << each.command;
    EXPECT_FALSE(std::filesystem::exists(tree / "w121/n36.smc.png")) << "the other cell has no culture";
  }
}

TEST_F(TerrainBatch, CultureWithANameInUpperCaseStaysWithItsCell) {
  std::filesystem::create_directories(folder_.path() / "upper/W122");
  std::filesystem::copy(in() / "w122/n36.dt0", folder_.path() / "upper/W122/N36.DT0");
  ASSERT_TRUE(terrain::write_culture(folder_.path() / "upper/W122/N36.SMC.PNG", culture_at(kWest, 121)));
  for (const char* input : {"upper", "upper/W122/N36.DT0"}) {
    const auto converted = run("convert", folder_.path() / input, out());
    ASSERT_EQ(converted.code, 0) << converted.errors;
    EXPECT_TRUE(terrain::read_culture(out() / "w122/n36.smc.png", kWest).has_value()) << input;
    std::filesystem::remove_all(out());
  }
}

// Faults of a culture file: damaged, a link without a target, a folder.
TEST_F(TerrainBatch, ACellWithUnreadableCultureIsReportedAndNotWritten) {
  const std::filesystem::path culture = in() / "w122/n36.smc.png";
  const std::vector<std::function<void()>> faults = {[&] { std::ofstream(culture) << "no picture"; },
                                                     [&] { std::filesystem::create_symlink("nowhere", culture); },
                                                     [&] { std::filesystem::create_directory(culture); }};
  for (const auto& make_fault : faults) {
    make_fault();
    for (const std::string command : {"convert", "pack"}) {
      expect_refused(run(command, in(), out() / command), 1, {"problem: ", "n36.smc.png", "1 of 2"});
      EXPECT_FALSE(std::filesystem::exists(out() / command / "w122"));
      EXPECT_TRUE(std::filesystem::exists(out() / command / "w121"));
    }
    const auto info = endtoend::run_program({"yars", "terrain", "info", in().string()});
    EXPECT_EQ(info.code, 1);
    EXPECT_THAT(info.output, HasSubstr("n36.smc.png"));
    std::filesystem::remove(culture);
  }
}

TEST_F(TerrainBatch, AnOlderCultureOfACellWithoutCultureIsRemoved) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"convert"}, {"pack"}, {"reduce", "--reduction", "1"}}) {
    ASSERT_TRUE(terrain::write_culture(out() / "w122/n36.smc.png", culture_at(kWest, 121)));
    ASSERT_TRUE(terrain::write_culture(out() / "w122/N36.SMC.PNG", culture_at(kWest, 121)));
    ASSERT_TRUE(terrain::write_culture(out() / "w122/n35.smc.png", culture_at(kWest, 121)));
    const auto done = run(command[0], in(), out(), {command.begin() + 1, command.end()});
    ASSERT_EQ(done.code, 0) << done.errors;
    EXPECT_FALSE(terrain::find_culture(out() / "w122/n36.dt0").has_value()) << command[0];
    EXPECT_TRUE(std::filesystem::exists(out() / "w122/n35.smc.png")) << "culture of a cell that is not written";
  }
}

TEST_F(TerrainBatch, GenerationWithoutCultureRemovesAnOlderCulture) {
  const auto generate = [&](const char* culture) {
    return endtoend::run_program({"yars", "terrain", "generate", "--out", out(), "--level", "0", "--south", "36",
                                  "--west", "-122", "--cells-lat", "1", "--cells-lon", "1", "--sea", culture});
  };
  ASSERT_EQ(generate("--culture").code, 0);
  ASSERT_TRUE(std::filesystem::exists(out() / "w122/n36.smc.png"));
  ASSERT_EQ(generate("--no-culture").code, 0);
  EXPECT_FALSE(std::filesystem::exists(out() / "w122/n36.smc.png"));
}

TEST_F(TerrainBatch, CultureOfAnInputInTheOutputFolderIsKept) {
  ASSERT_TRUE(terrain::write_culture(in() / "w122/N36.SMC.PNG", culture_at(kWest, 121)));
  const auto packed = run("pack", in() / "w122/n36.dt0", in());
  ASSERT_EQ(packed.code, 0) << packed.errors;
  EXPECT_TRUE(terrain::read_culture(in() / "w122/N36.SMC.PNG", kWest).has_value());
}

TEST_F(TerrainBatch, AnOutputThatEndsLikeAFileIsRefused) {
  for (const std::string command : {"convert", "pack"})
    expect_refused(run(command, in(), folder_.path() / "a.tif"), 2, {"--out", "the name of a folder", "a.tif"});
  expect_refused(run("reduce", in(), in() / "w122/n36.dt0", {"--level", "0"}), 2, {"--out", "the name of a folder"});
  expect_refused(endtoend::run_program({"yars", "terrain", "generate", "--out", folder_.path() / "a.dt1"}), 2,
                 {"--out", "the name of a folder"});
}

TEST_F(TerrainBatch, AFileThatCannotBeUsedIsReportedAndOtherCellsAreWritten) {
  std::ofstream(in() / "broken.ded") << "nothing";
  expect_refused(run("convert", in(), out()), 1, {"problem: ", "broken.ded"});
  EXPECT_TRUE(std::filesystem::exists(out() / "w122/n36.dt0"));
}

TEST_F(TerrainBatch, AFileThatNoCellNeedsIsNotedOnly) {
  ASSERT_TRUE(terrain::write_dted(folder_.path() / "more", cell_at(kWest), 0));
  std::filesystem::create_directory(in() / "again");
  std::filesystem::rename(folder_.path() / "more/w122", in() / "again/w122");
  const auto done = run("convert", in(), out());
  EXPECT_EQ(done.code, 0) << done.errors;
  EXPECT_THAT(done.errors, HasSubstr("note: "));
  EXPECT_THAT(done.errors, HasSubstr("w122/n36.dt0: not used"));
}

TEST_F(TerrainBatch, DtedOfAnyNameIsConvertedByItsHeader) {
  const std::filesystem::path file = folder_.path() / "n36_w122_30arc_v3.dt0";
  std::filesystem::rename(in() / "w122/n36.dt0", file);
  const auto done = run("convert", file, out());
  ASSERT_EQ(done.code, 0) << done.errors;
  EXPECT_TRUE(test::same_posts(read(out() / "w122/n36.dt0", kWest).cell, cell_at(kWest)));
}

TEST_F(TerrainBatch, ACellWithoutAnyHeightIsReported) {
  const auto all_void = test::cell_of(kWest, 121, 121, [](int, int) { return int{terrain::kVoidPost}; });
  ASSERT_TRUE(terrain::write_dted(in(), all_void, 0));
  for (const std::string command : {"convert", "pack"})
    expect_refused(run(command, in(), out() / command), 1, {"problem: ", "n36.dt0", "14641 posts without any"});
  EXPECT_TRUE(std::filesystem::exists(out() / "pack/w122/n36.jp2")) << "void is not sea";
}

TEST_F(TerrainBatch, TheScenesOfTheFolderAreCopied) {
  folder_.write("in/scenes/town.flt", std::vector<std::byte>(7, std::byte{1}));
  folder_.write("in/scenes/textures/wall.rgb", std::vector<std::byte>(5, std::byte{2}));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"convert"}, {"pack"}, {"reduce", "--reduction", "1"}}) {
    const auto tree = out() / command[0];
    const auto done = run(command[0], in(), tree, {command.begin() + 1, command.end()});
    ASSERT_EQ(done.code, 0) << done.errors;
    EXPECT_THAT(done.output, HasSubstr("2 scene files copied"));
    EXPECT_EQ(std::filesystem::file_size(tree / "scenes/town.flt"), 7U);
    EXPECT_EQ(std::filesystem::file_size(tree / "scenes/textures/wall.rgb"), 5U);
  }
  std::filesystem::create_symlink("/etc/passwd", in() / "scenes/leak.flt");
  expect_refused(run("pack", in(), out() / "again"), 1, {"leak.flt", "a link that leads out"});
  EXPECT_FALSE(std::filesystem::exists(out() / "again/scenes/leak.flt"));
}

TEST_F(TerrainBatch, AMissingInputFolderIsAnError) {
  for (const char* command : {"convert", "pack"})
    expect_refused(run(command, folder_.path() / "nowhere", out()), 1, {"nowhere", "expected", "found"});
  expect_refused(run("reduce", folder_.path() / "nowhere", out(), {"--reduction", "1"}), 1, {"nowhere"});
}

TEST_F(TerrainBatch, ATruncatedCellIsReportedAndTheOtherIsWritten) {
  const std::filesystem::path victim = in() / "w122" / "n36.dt0";
  std::filesystem::resize_file(victim, std::filesystem::file_size(victim) / 2);
  for (const std::string command : {"convert", "pack"}) {
    const auto target = out() / command;
    expect_refused(run(command, in(), target), 1, {"problem: ", "w122/n36.dt0", "1 of 2"});
    EXPECT_FALSE(std::filesystem::exists(target / "w122"));
    EXPECT_TRUE(std::filesystem::exists(target / "w121"));
  }
}

TEST_F(TerrainBatch, AFileOfAnUnknownFormatIsRefused) {
  const std::filesystem::path text = folder_.path() / "notes.txt";
  folder_.write("notes.txt", std::vector<std::byte>(300, std::byte{65}));
  for (const char* command : {"convert", "pack"}) expect_refused(run(command, text, out()), 1, {"notes.txt"});
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(TerrainBatch, AnOutputThatCannotBeWrittenIsReported) {
  // A file has the name of the output folder, so that not even root can write there.
  folder_.write("out", std::vector<std::byte>(3));
  for (const char* command : {"convert", "pack"}) {
    const auto refused = run(command, in(), out());
    expect_refused(refused, 1, {"problem: ", out().string(), "2 of 2"});
    EXPECT_THAT(refused.output, Not(HasSubstr("1/2")));
  }
}

TEST_F(TerrainBatch, AnOutputInsideTheInputIsRefused) {
  expect_refused(run("convert", in(), in()), 2, {"--out outside of --in"});
  expect_refused(run("pack", in(), in() / "packed"), 2, {"--out outside of --in"});
  EXPECT_TRUE(test::same_posts(read(in() / "w122" / "n36.dt0", kWest).cell, cell_at(kWest)));
}

TEST_F(TerrainBatch, ReduceNeedsEitherReductionOrLevel) {
  expect_refused(run("reduce", in(), out()), 2, {"--reduction", "--level", "none"});
  expect_refused(run("reduce", in(), out(), {"--reduction", "1", "--level", "0"}), 2, {"both"});
  EXPECT_EQ(run("reduce", in(), out(), {"--reduction", "13"}).code, 2);
  EXPECT_EQ(run("convert", in(), out(), {"--to", "tif"}).code, 2);
}

}  // namespace
}  // namespace yars
