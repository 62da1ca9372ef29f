#include "model/terrain/directory_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/terrain/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::HasSubstr;

const std::vector<std::byte> kAnything(10);
const std::vector<std::byte> kHgtOfOneSecond(2UL * 3601 * 3601);

std::string chosen(const test::TemporaryFolder& folder, CellPlace place) {
  const auto index = index_directory(folder.path());
  if (!index || index->count(slot_of(place)) == 0) return "none";
  return std::filesystem::relative(index->at(slot_of(place)).path, folder.path()).string();
}

TEST(DirectoryIndex, NamesGiveThePlace) {
  EXPECT_EQ(cell_named("w122", "n36.dt1")->place, (CellPlace{36, -122}));
  EXPECT_EQ(cell_named("E013", "S54.DT0")->place, (CellPlace{-54, 13}));
  EXPECT_EQ(cell_named("anywhere", "N36W122.hgt")->place, (CellPlace{36, -122}));
  EXPECT_EQ(cell_named("anywhere", "s46w066.HGT.GZ")->place, (CellPlace{-46, -66}));
  EXPECT_EQ(cell_named("anywhere", "N43E007.hgt.zip")->format, CellFormat::packed_hgt);
}

TEST(DirectoryIndex, OtherNamesAreNoCells) {
  EXPECT_FALSE(cell_named("somewhere", "n36.dt1").has_value());
  EXPECT_FALSE(cell_named("w122", "n36.dt3").has_value());
  EXPECT_FALSE(cell_named("w122", "n90.dt1").has_value());
  EXPECT_FALSE(cell_named("w181", "n36.dt1").has_value());
  EXPECT_FALSE(cell_named("e180", "n36.dt1").has_value());
  EXPECT_FALSE(cell_named("w122", "n36.dt1.tmp").has_value());
  EXPECT_FALSE(cell_named("x", "N36W122.hgt.7z").has_value());
  EXPECT_FALSE(cell_named("", "").has_value());
}

TEST(DirectoryIndex, CellsAreFoundAtAnyDepth) {
  const test::TemporaryFolder folder;
  folder.write("a/b/c/w122/n36.dt1", kAnything);
  folder.write("N01E002.hgt", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "a/b/c/w122/n36.dt1");
  EXPECT_EQ(chosen(folder, {1, 2}), "N01E002.hgt");
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

TEST(DirectoryIndex, APackedFileServesOnlyWhereNothingElseDoes) {
  const test::TemporaryFolder folder;
  folder.write("N36W122.hgt.zip", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "N36W122.hgt.zip");
  folder.write("w122/n36.dt0", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "w122/n36.dt0");
}

TEST(DirectoryIndex, OfEqualsTheFirstPathWinsHoweverTheDirectoryIsOrdered) {
  const test::TemporaryFolder folder;
  for (const char* name : {"m", "z", "b", "k"}) folder.write(std::string(name) + "/w122/n36.dt1", kAnything);
  EXPECT_EQ(chosen(folder, {36, -122}), "b/w122/n36.dt1");
}

TEST(DirectoryIndex, AMissingDirectoryAndOneWithoutCellsAreErrors) {
  const test::TemporaryFolder folder;
  folder.write("readme.txt", kAnything);
  EXPECT_THAT(index_directory(folder.path()).error().message(), HasSubstr("elevation cells"));
  EXPECT_THAT(index_directory(folder.path() / "gone").error().message(), HasSubstr("directory"));
}

}  // namespace
}  // namespace yars::model::terrain
