// Culture (surface material by area): lookup by position, and reading and writing of the file beside a cell.
#include "model/terrain/formats/culture.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lib/imageio/png.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

constexpr CellCorner kCorner{36, -122};

Culture small_culture() {
  std::vector<std::uint8_t> codes;
  for (int code = 0; code < 12; ++code) codes.push_back(static_cast<std::uint8_t>(code));
  return Culture(kCorner, 4, 3, codes);
}

TEST(Culture, IsUnchangedAfterWritingAndReading) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "w122" / "n36.smc.png";
  ASSERT_TRUE(write_culture(path, small_culture()).has_value());
  const auto read = read_culture(path, kCorner);
  ASSERT_TRUE(read.has_value()) << read.error().message();
  ASSERT_EQ(read->rows(), 4);
  ASSERT_EQ(read->columns(), 3);
  EXPECT_EQ(read->posts(), small_culture().posts());
}

TEST(Culture, HasNorthOnTopInItsPicture) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "n36.smc.png";
  ASSERT_TRUE(write_culture(path, small_culture()).has_value());
  const auto image = imageio::read_indexed_png(path, 100);
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(image->pixels[0], small_culture().post(3, 0).material);
  EXPECT_EQ(image->pixels[11], small_culture().post(0, 2).material);
  const auto water = static_cast<std::size_t>(Material::water);
  EXPECT_GT(image->palette[water][2], image->palette[water][0]) << "water looks blue";
}

TEST(Culture, HasTheMaterialOfTheNearestPost) {
  const Culture culture = small_culture();
  EXPECT_EQ(culture.nearest(0.0, 0.0).material, 0);
  EXPECT_EQ(culture.nearest(1.0, 1.0).material, 11);
  EXPECT_EQ(culture.nearest(0.4, 0.6).material, culture.post(1, 1).material);
  EXPECT_EQ(culture.nearest(-3.0, 7.0).material, culture.post(0, 2).material)
      << "outside: the nearest post of the edge";
}

TEST(Culture, KeepsSharesOfWater) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "n36.smc.png";
  const std::vector<Cover> covers{{12, 0.0}, {12, 0.4}, {0, 1.0}, {6, {}}, {31, 0.5}, {10, {}}};
  std::vector<std::uint8_t> bytes;
  for (const Cover& cover : covers) bytes.push_back(cover_byte(cover));
  ASSERT_TRUE(write_culture(path, Culture(kCorner, 2, 3, bytes)).has_value());
  const auto read = read_culture(path, kCorner);
  ASSERT_TRUE(read.has_value()) << read.error().message();
  EXPECT_TRUE(read->has_water());
  for (int post = 0; post < 6; ++post) {
    const Cover found = read->post(post / 3, post % 3), &written = covers[static_cast<std::size_t>(post)];
    EXPECT_EQ(found.material, written.material) << post;
    ASSERT_EQ(found.water.has_value(), written.water.has_value()) << post;
    EXPECT_NEAR(found.water.value_or(0.0), written.water.value_or(0.0), 1.0 / 12.0) << post;
  }
  EXPECT_FALSE(small_culture().has_water());
}

TEST(CultureTile, IsBesideTheElevationCell) {
  EXPECT_EQ(culture_path("db/w122/n36.dt1"), "db/w122/n36.smc.png");
  EXPECT_EQ(culture_path("db/N36W122.hgt"), "db/N36W122.smc.png");
  EXPECT_EQ(culture_path("db/N36W122.hgt.gz"), "db/N36W122.smc.png");
  const test::TemporaryFolder folder;
  const auto elevation = folder.path() / "w122" / "n36.dt1";
  EXPECT_FALSE(find_culture(elevation).has_value());
  ASSERT_TRUE(write_culture(culture_path(elevation), small_culture()).has_value());
  EXPECT_EQ(find_culture(elevation), culture_path(elevation));
}

TEST(CultureTile, IsFoundUnderANameOfEitherCase) {
  EXPECT_EQ(culture_path("db/N36W122.HGT.ZIP"), "db/N36W122.smc.png");
  const test::TemporaryFolder folder;
  const auto upper = folder.path() / "W122" / "N36.SMC.PNG";
  ASSERT_TRUE(write_culture(upper, small_culture()).has_value());
  for (const char* name : {"N36.DT1", "n36.dt1", "N36.dt1"})
    EXPECT_EQ(find_culture(folder.path() / "W122" / name), upper);
  EXPECT_FALSE(find_culture(folder.path() / "W122" / "N37.DT1").has_value());
  const auto lower = folder.path() / "W122" / "n36.smc.png";
  ASSERT_TRUE(write_culture(lower, small_culture()).has_value());
  EXPECT_EQ(find_culture(folder.path() / "W122" / "n36.dt1"), lower) << "the name with the same case comes first";
}

TEST(CultureTile, ADanglingLinkOrAFolderIsFoundAndCannotBeRead) {
  const test::TemporaryFolder folder;
  std::filesystem::create_symlink("nowhere", folder.path() / "n36.smc.png");
  std::filesystem::create_directory(folder.path() / "n37.smc.png");
  for (const char* name : {"n36.dt1", "n37.dt1"}) {
    const auto path = find_culture(folder.path() / name);
    ASSERT_TRUE(path.has_value()) << name;
    EXPECT_FALSE(read_culture(*path, kCorner).has_value()) << name;
  }
}

TEST(CultureTile, IsRemovedUnderEveryCase) {
  const test::TemporaryFolder folder;
  for (const char* name : {"n36.smc.png", "N36.SMC.PNG", "n37.smc.png"})
    ASSERT_TRUE(write_culture(folder.path() / name, small_culture()).has_value());
  ASSERT_TRUE(remove_culture(folder.path() / "n36.dt1").has_value());
  EXPECT_FALSE(find_culture(folder.path() / "n36.dt1").has_value());
  EXPECT_TRUE(find_culture(folder.path() / "n37.dt1").has_value());
  std::filesystem::create_directory(folder.path() / "n36.smc.png");
  const auto removed = remove_culture(folder.path() / "n36.dt1");
  ASSERT_FALSE(removed.has_value());
  EXPECT_NE(removed.error().message().find("n36.smc.png"), std::string::npos);
}

TEST(CultureReader, ACodeBeyondDfadIsRefusedWithItsPosition) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "n36.smc.png";
  imageio::IndexedImage image{3, 2, {0, 31, 0, 0, 0, 32}, {}};
  image.palette.resize(64);
  ASSERT_TRUE(imageio::write_indexed_png(path, image).has_value());
  const auto read = read_culture(path, kCorner);
  ASSERT_FALSE(read.has_value());
  EXPECT_NE(read.error().message().find("code 32 at column 2 of row 1"), std::string::npos) << read.error().message();
}

TEST(CultureReader, FilesWithoutCultureAreErrors) {
  const test::TemporaryFolder folder;
  folder.write("text.smc.png", std::vector<std::byte>(200, std::byte{65}));
  EXPECT_FALSE(read_culture(folder.path() / "text.smc.png", kCorner).has_value());
  const auto gray = folder.path() / "gray.smc.png";
  ASSERT_TRUE(imageio::write_png(gray, imageio::Image{3, 3, 1, std::vector<std::uint8_t>(9)}).has_value());
  EXPECT_FALSE(read_culture(gray, kCorner).has_value());
  const auto line = folder.path() / "line.smc.png";
  ASSERT_TRUE(imageio::write_indexed_png(line, {1, 5, std::vector<std::uint8_t>(5), {{0, 0, 0}}}).has_value());
  const auto read = read_culture(line, kCorner);
  ASSERT_FALSE(read.has_value());
  EXPECT_NE(read.error().message().find("1 x 5"), std::string::npos) << read.error().message();
}

}  // namespace
}  // namespace yars::model::terrain
