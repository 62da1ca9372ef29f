// write_indexed_png() and read_indexed_png(): PNG files with a palette. Written images are read back unchanged.
// RGB images, too large images, damaged files and missing files are errors.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lib/imageio/png.hpp"
#include "tests/lib/imageio/read_png.hpp"

namespace yars::imageio {
namespace {

class IndexedPng : public testing::Test {
 protected:
  IndexedPng() {
    std::string pattern = (std::filesystem::temp_directory_path() / "yars-indexed-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    folder_ = pattern;
    path_ = folder_ / "image.png";
  }
  ~IndexedPng() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  // 5 x 3 pixels with the indices 0 to 14, and a palette of 20 colours.
  static IndexedImage sample_image() {
    IndexedImage image{5, 3, {}, {}};
    for (std::uint8_t pixel = 0; pixel < 15; ++pixel) image.pixels.push_back(pixel);
    for (std::uint8_t colour = 0; colour < 20; ++colour) image.palette.push_back({colour, 9, 200});
    return image;
  }
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void put(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  std::filesystem::path folder_;
  std::filesystem::path path_;
};

TEST_F(IndexedPng, IndicesAndPaletteComeBack) {
  ASSERT_TRUE(write_indexed_png(path_, sample_image()).has_value());
  const auto read = read_indexed_png(path_, 100);
  ASSERT_TRUE(read.has_value()) << read.error().message();
  EXPECT_EQ(read->width, 5);
  EXPECT_EQ(read->height, 3);
  EXPECT_EQ(read->pixels, sample_image().pixels);
  EXPECT_EQ(read->palette, sample_image().palette);
}

TEST_F(IndexedPng, AGeneralReaderSeesThePalettesColours) {
  ASSERT_TRUE(write_indexed_png(path_, sample_image()).has_value());
  const auto picture = test::read_png(path_);
  ASSERT_TRUE(picture.has_value());
  ASSERT_EQ(picture->channels, 3);
  EXPECT_EQ(picture->pixels[3 * 7], 7);
  EXPECT_EQ(picture->pixels[3 * 7 + 2], 200);
}

TEST_F(IndexedPng, AnRgbImageIsRefused) {
  ASSERT_TRUE(write_png(path_, Image{2, 2, 3, std::vector<std::uint8_t>(12)}).has_value());
  const auto read = read_indexed_png(path_, 100);
  ASSERT_FALSE(read.has_value());
  EXPECT_NE(read.error().message().find("indexed"), std::string::npos) << read.error().message();
}

TEST_F(IndexedPng, AnImageBeyondTheSizeLimitIsRefused) {
  ASSERT_TRUE(write_indexed_png(path_, sample_image()).has_value());
  EXPECT_FALSE(read_indexed_png(path_, 4).has_value());
  EXPECT_TRUE(read_indexed_png(path_, 5).has_value());
}

TEST_F(IndexedPng, EveryTruncationIsAnError) {
  ASSERT_TRUE(write_indexed_png(path_, sample_image()).has_value());
  const std::string complete = bytes();
  for (std::size_t length = 0; length + 1 < complete.size(); ++length) {
    put(complete.substr(0, length));
    EXPECT_FALSE(read_indexed_png(path_, 100).has_value()) << length << " of " << complete.size() << " bytes";
  }
}

TEST_F(IndexedPng, EveryInvertedByteGivesAnErrorOrACompleteImage) {
  ASSERT_TRUE(write_indexed_png(path_, sample_image()).has_value());
  const std::string complete = bytes();
  for (std::size_t at = 0; at < complete.size(); ++at) {
    std::string damaged = complete;
    damaged[at] = static_cast<char>(~damaged[at]);
    put(damaged);
    const auto read = read_indexed_png(path_, 100);
    if (read) {
      EXPECT_EQ(read->pixels.size(), static_cast<std::size_t>(read->width * read->height));
    }
  }
}

TEST_F(IndexedPng, AMissingFileAndAMissingFolderAreErrors) {
  EXPECT_FALSE(read_indexed_png(folder_ / "absent.png", 100).has_value());
  EXPECT_FALSE(write_indexed_png(folder_ / "absent" / "image.png", sample_image()).has_value());
}

}  // namespace
}  // namespace yars::imageio
