// Index of a folder of elevation files: names, the choice among files for one cell, and unusable files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tests/model/terrain/formats/ded_builder.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::byte> kAnything(10);  // no valid content of any format
const std::vector<std::byte> kHgtOfOneSecond(2UL * 3601 * 3601);

// Path of the file that the index has for a cell, relative to the folder.
std::string chosen(const test::TemporaryFolder& folder, CellCorner corner) {
  const auto index = index_directory(folder.path());
  if (!index || index->count(slot_of(corner)) == 0) return "none";
  return std::filesystem::relative(index->at(slot_of(corner)).path, folder.path()).string();
}

TEST(DirectoryIndex, NamesGiveTheCell) {
  EXPECT_EQ(cell_named("w122", "n36.dt1")->corner, (CellCorner{36, -122}));
  EXPECT_EQ(cell_named("E013", "S54.DT0")->corner, (CellCorner{-54, 13}));
  EXPECT_EQ(cell_named("anywhere", "N36W122.hgt")->corner, (CellCorner{36, -122}));
  EXPECT_EQ(cell_named("anywhere", "s46w066.HGT.GZ")->corner, (CellCorner{-46, -66}));
  EXPECT_EQ(cell_named("anywhere", "N43E007.hgt.zip")->format, CellFormat::compressed_hgt);
  EXPECT_EQ(cell_named("W122", "N36.JP2")->format, CellFormat::pack);
}

TEST(DirectoryIndex, OtherNamesAreNoCells) {
  EXPECT_FALSE(cell_named("somewhere", "n36.dt1").has_value());
  EXPECT_FALSE(cell_named("w122", "n36.dt3").has_value());
  EXPECT_FALSE(cell_named("w122", "n90.dt1").has_value());
  EXPECT_FALSE(cell_named("w181", "n36.dt1").has_value());
  EXPECT_FALSE(cell_named("e180", "n36.dt1").has_value());
  EXPECT_FALSE(cell_named("w122", "n36.dt1.tmp").has_value());
  EXPECT_FALSE(cell_named("x", "N36W122.hgt.7z").has_value());
  EXPECT_FALSE(cell_named("somewhere", "n36.jp2").has_value());
  EXPECT_FALSE(cell_named("w122", "n36.side").has_value());
  EXPECT_FALSE(cell_named("", "").has_value());
}

TEST(DirectoryIndex, HgtIsFoundUnderTheNamesOfItsProducers) {
  for (const char* name : {"N31E036.SRTMGL3.hgt", "N31E036 (1).hgt", "n31_e036_3arc_v2.hgt"}) {
    const test::TemporaryFolder folder;
    folder.write(name, kHgtOfOneSecond);
    EXPECT_EQ(chosen(folder, {31, 36}), name);
    folder.write("N31E036.hgt", kHgtOfOneSecond);
    EXPECT_EQ(chosen(folder, {31, 36}), "N31E036.hgt") << "the shorter name";
  }
}

TEST(DirectoryIndex, DtedOfAnyNameLiesWhereItsHeaderSays) {
  const test::TemporaryFolder folder;
  folder.write("n31_e037_3arc_v2.dt1", test::level_dted(31, 37, 5).bytes());
  folder.write("w122/mine.dt0", test::level_dted(36, -122, 6).bytes());
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  EXPECT_EQ(chosen(folder, {31, 37}), "n31_e037_3arc_v2.dt1");
  EXPECT_EQ(chosen(folder, {36, -122}), "w122/mine.dt0");
  EXPECT_EQ(index->at(slot_of({31, 37})).posts_per_degree, 4) << "of the header, not of the level";
  const auto reading = read_cell(index->at(slot_of({36, -122})), {36, -122});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->cell.post(0, 0), 6);
  folder.write("renamed.bin", test::level_dted(12, 13, 7).bytes());
  EXPECT_EQ(index_file(folder.path() / "renamed.bin")->begin()->first, slot_of({12, 13}));
}

TEST(DirectoryIndex, EachUnusedFileIsListedOnceWithItsReason) {
  const test::TemporaryFolder folder;
  folder.write("w122/n36.dt1", kAnything);
  folder.write("w122/n36.dt0", kAnything);
  folder.write("copy/w122/n36.dt1", kAnything);
  for (const char* beside :
       {"w122/n36.smc.png", "N36W122.hgt.aux.xml", "readme.txt", "scenes/N36W122.flt", "N36W122.png", "._N36W122.hgt"})
    folder.write(beside, kAnything);
  FileSentences found;
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_THAT(found.problems, ElementsAre(AllOf(HasSubstr("w122/n36.smc.png: expected beside it"))))
      << "the cell is read from another folder, without its materials";
  std::filesystem::remove(folder.path() / "w122/n36.smc.png");
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_THAT(found.problems, ::testing::IsEmpty());
  EXPECT_THAT(found.notes,
              ElementsAre(AllOf(HasSubstr("w122/n36.dt0: not used"), HasSubstr("copy/w122/n36.dt1, which has finer")),
                          AllOf(HasSubstr("w122/n36.dt1: not used"), HasSubstr("which has posts as fine"))));
  for (const char* unread :
       {"N37W122.hgt.7z", "cell.hgt", "dem.asc", "dem.nc", "w122/n38.dt3", "broken.dt1", "tile.zip"})
    folder.write(unread, kAnything);
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_EQ(found.problems.size(), 7U) << ::testing::PrintToString(found.problems);
}

TEST(DirectoryIndex, CellsAreFoundAtAnyDepth) {
  const test::TemporaryFolder folder;
  folder.write("a/b/c/w122/n36.dt1", kAnything);
  folder.write("N01E002.hgt", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "a/b/c/w122/n36.dt1");
  EXPECT_EQ(chosen(folder, {1, 2}), "N01E002.hgt");
}

TEST(DirectoryIndex, TheNorthAndEastEdgeOfTheOutermostCellsBelongToThem) {
  const DirectoryIndex index{{slot_of({39, -115}), {}}, {slot_of({0, 179}), {}}};
  const auto cell_of = [&](double latitude_deg, double longitude_deg) {
    return cell_containing(within_index(index, {latitude_deg, longitude_deg}));
  };
  EXPECT_EQ(cell_of(40.0, -114.5), (CellCorner{39, -115}));
  EXPECT_EQ(cell_of(39.5, -114.0), (CellCorner{39, -115}));
  EXPECT_EQ(cell_of(40.0, -114.0), (CellCorner{39, -115}));
  EXPECT_EQ(cell_of(0.5, 180.0), (CellCorner{0, 179}));
  EXPECT_EQ(cell_of(1.0, -180.0), (CellCorner{0, 179}));
  EXPECT_EQ(cell_of(40.1, -114.5), (CellCorner{40, -115}));  // outside
  EXPECT_EQ(cell_of(39.0, -115.0), (CellCorner{39, -115}));
  EXPECT_EQ(cell_of(-90.0, 0.0), (CellCorner{-90, 0}));
}

TEST(DirectoryIndex, ACellHasItsCultureUnderANameOfEitherCase) {
  const test::TemporaryFolder folder;
  for (const char* name : {"W122/N36.DT1", "W122/N36.SMC.PNG", "W122/N37.DT1", "N38W122.hgt", "n38w122.smc.png"})
    folder.write(name, std::vector<std::byte>(3));
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  EXPECT_EQ(index->at(slot_of({36, -122})).culture, folder.path() / "W122/N36.SMC.PNG");
  EXPECT_EQ(index->at(slot_of({37, -122})).culture, std::nullopt);
  EXPECT_EQ(index->at(slot_of({38, -122})).culture, folder.path() / "n38w122.smc.png");
}

TEST(DirectoryIndex, TheFinestSpacingWins) {
  const test::TemporaryFolder folder;
  folder.write("w122/n36.dt0", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "w122/n36.dt0");
  folder.write("w122/n36.dt1", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "w122/n36.dt1");
  folder.write("N36W122.hgt", kHgtOfOneSecond);
  EXPECT_EQ(chosen(folder, {36, -122}), "N36W122.hgt");
  folder.write("w122/n36.dt2", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "w122/n36.dt2");
}

TEST(DirectoryIndex, ACompressedFileOfUnknownSpacingIsUsedOnlyWithoutAnother) {
  const test::TemporaryFolder folder;
  folder.write("N36W122.hgt.zip", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "N36W122.hgt.zip");
  folder.write("w122/n36.dt0", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "w122/n36.dt0");
}

TEST(DirectoryIndex, AmongEqualFilesTheFirstPathInTheAlphabetWins) {
  const test::TemporaryFolder folder;
  for (const char* name : {"m", "z", "b", "k"}) folder.write(std::string(name) + "/w122/n36.dt1", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "b/w122/n36.dt1");
}

TEST(DirectoryIndex, TheSpacingIsKnownToTheNorthAndToTheEast) {
  const test::TemporaryFolder folder;
  folder.write("e013/n54.dt1", kAnything);
  test::DedFile ded;
  ded.cells = {test::ded_cell(36, -122, 5, 4)};
  folder.write("area.ded", ded.bytes());
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  EXPECT_EQ(index->at(slot_of({54, 13})).posts_per_degree, 1200);
  EXPECT_EQ(index->at(slot_of({54, 13})).posts_per_degree_east, 600);
  EXPECT_EQ(index->at(slot_of({36, -122})).posts_per_degree, 4);
  EXPECT_EQ(index->at(slot_of({36, -122})).posts_per_degree_east, 3);
}

TEST(DirectoryIndex, AFileThatCannotBeUsedIsReportedAndOtherFilesAreUsed) {
  const test::TemporaryFolder folder;
  folder.write("w122/n36.dt1", kAnything);
  folder.write("broken.ded", kAnything);
  folder.write("pointer.VRT", kAnything);
  FileSentences found;
  const auto index = index_directory(folder.path(), &found);
  ASSERT_TRUE(index.has_value());
  EXPECT_EQ(index->size(), 1U);
  EXPECT_THAT(found.problems, ElementsAre(HasSubstr("broken.ded"), HasSubstr("gdal_translate")));
  std::filesystem::remove_all(folder.path() / "w122");
  EXPECT_THAT(index_directory(folder.path()).error().message(), HasSubstr("broken.ded"));
}

// If the test runs as root, the process acts as user 65534 while this object exists, and permissions apply.
class WithoutRights {
 public:
  WithoutRights() : user_(geteuid()) {
    if (user_ == 0 && seteuid(65534) != 0) std::abort();
  }
  WithoutRights(const WithoutRights&) = delete;
  WithoutRights& operator=(const WithoutRights&) = delete;
  ~WithoutRights() {
    if (seteuid(user_) != 0) std::abort();
  }

 private:
  uid_t user_;
};

TEST(DirectoryIndex, AFolderWithoutReadPermissionIsReportedAsSuch) {
  const test::TemporaryFolder folder;
  folder.write("open/w122/n36.dt0", test::level_dted(36, -122, 5).bytes());
  folder.write("closed/w121/n36.dt0", test::level_dted(36, -121, 5).bytes());
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms::none);
  {
    const WithoutRights as_nobody;
    const auto closed = index_directory(folder.path() / "closed");
    ASSERT_FALSE(closed.has_value());
    EXPECT_THAT(closed.error().message(), HasSubstr("found permission denied"));
    FileSentences found;
    const auto index = index_directory(folder.path(), &found);
    ASSERT_TRUE(index.has_value()) << index.error().message();
    EXPECT_EQ(index->size(), 1U);
    EXPECT_THAT(found.problems, ElementsAre(AllOf(HasSubstr("closed"), HasSubstr("found permission denied"))));
  }
  std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms::all);
}

TEST(DirectoryIndex, WithoutGdalEachRasterIsReportedWithTheSetupCommand) {
  if (gdal::available()) GTEST_SKIP() << "this build has GDAL";
  const test::TemporaryFolder folder;
  folder.write("w122/n36.dt1", kAnything);
  folder.write("a.tif", kAnything);
  folder.write("b.img", kAnything);
  FileSentences found;
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_THAT(found.problems, ElementsAre(HasSubstr("scripts/setup --gdal"), HasSubstr("scripts/setup --gdal")));
}

TEST(DirectoryIndex, IndexFileListsTheCellsOfOneFile) {
  const test::TemporaryFolder folder;
  test::DedFile ded;
  ded.cells = {test::ded_cell(36, -122, 5, 4), test::ded_cell(37, -122, 5, 4)};
  folder.write("area.ded", ded.bytes());
  folder.write("w122/n36.dt0", kAnything);
  EXPECT_EQ(index_file(folder.path() / "area.ded")->size(), 2U);
  EXPECT_EQ(index_file(folder.path() / "w122/n36.dt0")->at(slot_of({36, -122})).format, CellFormat::dted);
  EXPECT_THAT(index_file(folder.path() / "gone.ded").error().message(), HasSubstr("gone.ded"));
  folder.write("readme.txt", kAnything);
  EXPECT_THAT(index_file(folder.path() / "readme.txt").error().message(), HasSubstr("readme.txt"));
}

TEST(DirectoryIndex, AMissingDirectoryAndADirectoryWithoutCellsAreErrors) {
  const test::TemporaryFolder folder;
  folder.write("readme.txt", kAnything);
  EXPECT_THAT(index_directory(folder.path()).error().message(), HasSubstr("elevation cells"));
  EXPECT_THAT(index_directory(folder.path() / "gone").error().message(), HasSubstr("directory"));
}

}  // namespace
}  // namespace yars::model::terrain
