// write_png(): the test reader returns every written pixel; an error names a folder that does not exist.
#include "lib/imageio/png.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "tests/lib/imageio/read_png.hpp"

namespace yars::imageio {
namespace {

using ::testing::HasSubstr;

class Png : public ::testing::Test {
 protected:
  Png() { std::filesystem::create_directories(folder_); }
  ~Png() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("yars-png-" + std::to_string(getpid()) + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

// Image of random pixels.
Image noise(int width, int height, int channels) {
  constexpr std::uint32_t kSeed = 70;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> byte(0, 255);
  Image image{width, height, channels, {}};
  image.pixels.resize(static_cast<std::size_t>(width * height * channels));
  for (auto& pixel : image.pixels) pixel = static_cast<std::uint8_t>(byte(random));
  return image;
}

TEST_F(Png, EveryPixelComesBack) {
  for (const int channels : {1, 3, 4}) {
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{7, 5}, std::pair{480, 481}}) {
      const Image image = noise(width, height, channels);
      ASSERT_TRUE(write_png(path("a.png"), image));
      const auto back = test::read_png(path("a.png"));
      ASSERT_TRUE(back) << back.error().message();
      EXPECT_EQ(back->width, width);
      EXPECT_EQ(back->height, height);
      EXPECT_EQ(back->channels, channels);
      EXPECT_TRUE(back->pixels == image.pixels) << channels << " channels, " << width << " x " << height;
    }
  }
}

TEST_F(Png, AMissingFolderIsNamed) {
  const auto written = write_png(path("nowhere/a.png"), noise(2, 2, 1));
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message(), HasSubstr("nowhere"));
}

TEST_F(Png, TheErrorOfAFullDiskSaysSo) {
  const auto gray = write_png("/dev/full", noise(480, 480, 1));
  ASSERT_FALSE(gray);
  EXPECT_THAT(gray.error().message(), HasSubstr("No space left"));
  const Image pixels = noise(480, 480, 1);
  const auto indexed = write_indexed_png(
      "/dev/full", {480, 480, pixels.pixels, std::vector<PaletteColour>(256, PaletteColour{1, 2, 3})});
  ASSERT_FALSE(indexed);
  EXPECT_THAT(indexed.error().message(), HasSubstr("No space left"));
}

}  // namespace
}  // namespace yars::imageio
