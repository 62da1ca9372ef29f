// Frames as messages: a page that applies them has the published pixels, whatever it missed; each is encoded once.
#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <random>
#include <vector>

#include "station/page_message.hpp"

namespace yars::station {
namespace {

using Pixels = std::vector<std::uint8_t>;

databuffer::GlassFrame frame_of(std::uint64_t id, std::uint32_t width, std::uint32_t height) {
  databuffer::GlassFrame frame{};
  frame.id = id;
  frame.sim_time_ns = static_cast<std::int64_t>(id) * 20'000'000;
  frame.width = width;
  frame.height = height;
  return frame;
}

std::uint64_t number_at(const Pixels& bytes, std::size_t at, int count) {
  std::uint64_t number = 0;
  for (int i = count - 1; i >= 0; --i) number = number << 8 | bytes[at + static_cast<std::size_t>(i)];
  return number;
}

// A page: applies messages to its picture.
struct Page {
  std::uint64_t id = 0;
  std::size_t width = 0, height = 0;
  Pixels pixels;  // RGBA

  void apply(const Pixels& message) {
    const std::uint64_t base = number_at(message, 8, 8);
    ASSERT_TRUE(base == 0 || base == id) << "a change of another frame";
    id = number_at(message, 0, 8);
    width = number_at(message, 16, 2);
    height = number_at(message, 18, 2);
    pixels.resize(width * height * 4);
    png_image png;
    std::memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&png, message.data() + FrameStream::kHeaderBytes,
                                               message.size() - FrameStream::kHeaderBytes),
              0);
    EXPECT_EQ(png.format, PNG_FORMAT_RGB);
    png.format = PNG_FORMAT_RGBA;
    Pixels part(PNG_IMAGE_SIZE(png));
    ASSERT_NE(png_image_finish_read(&png, nullptr, part.data(), 0, nullptr), 0);
    const std::size_t left = number_at(message, 20, 2), top = number_at(message, 22, 2);
    ASSERT_LE(left + png.width, width);
    ASSERT_LE(top + png.height, height);
    for (std::size_t row = 0; row < png.height; ++row)
      std::memcpy(&pixels[((top + row) * width + left) * 4], &part[row * png.width * 4], png.width * 4);
  }
};

TEST(FrameStream, HasNothingBeforeTheFirstFrameAndNothingTwice) {
  FrameStream stream;
  EXPECT_EQ(stream.message_after(0), nullptr);
  const Pixels pixels(4 * 3 * 4, 255);
  stream.take(frame_of(7, 4, 3), pixels);
  EXPECT_NE(stream.message_after(0), nullptr);
  EXPECT_EQ(stream.message_after(7), nullptr);
}

TEST(FrameStream, EncodesEachMessageOnce) {
  FrameStream stream;
  stream.take(frame_of(1, 2, 2), Pixels(16, 0));
  stream.take(frame_of(2, 2, 2), Pixels(16, 255));
  EXPECT_EQ(stream.message_after(1), stream.message_after(1));
  EXPECT_EQ(stream.message_after(0), stream.message_after(99));
  EXPECT_NE(stream.message_after(1), stream.message_after(0));
}

TEST(FrameStream, APageHasThePublishedPixelsWhateverItMissed) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto below = [&](std::size_t limit) { return random() % limit; };
  FrameStream stream;
  Page always, sometimes;
  std::size_t width = 33, height = 20;
  Pixels pixels(width * height * 4, 255);
  for (std::uint64_t id = 3; id < 300; id += 1 + below(2)) {
    if (below(40) == 0) {
      width = 1 + below(60);
      height = 1 + below(60);
      pixels.assign(width * height * 4, 255);
    }
    for (std::size_t change = below(4); change > 0; --change)
      pixels[below(width * height) * 4 + below(3)] = static_cast<std::uint8_t>(random());
    stream.take(frame_of(id, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)), pixels);
    ASSERT_NO_FATAL_FAILURE(always.apply(*stream.message_after(always.id)));
    EXPECT_EQ(always.pixels, pixels);
    if (below(3) == 0) {
      ASSERT_NO_FATAL_FAILURE(sometimes.apply(*stream.message_after(sometimes.id)));
      EXPECT_EQ(sometimes.pixels, pixels);
    }
  }
}

TEST(FrameStream, AChangeOfOnePixelIsSmall) {
  FrameStream stream;
  Pixels pixels(480 * 480 * 4, 255);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (i % 4 != 3) pixels[i] = static_cast<std::uint8_t>(random());
  stream.take(frame_of(1, 480, 480), pixels);
  pixels[0] ^= 1U;
  stream.take(frame_of(2, 480, 480), pixels);
  EXPECT_LT(stream.message_after(1)->size(), 200U);
  EXPECT_GT(stream.message_after(0)->size(), 480U * 480U * 2U);
}

}  // namespace
}  // namespace yars::station
