#include "lib/imageio/png.hpp"

#include <png.h>

#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "lib/failure/require.hpp"
#include "lib/file/new_file.hpp"

namespace yars::imageio {

namespace {

png_uint_32 format_of(int channels) {
  if (channels == 1) return PNG_FORMAT_GRAY;
  if (channels == 3) return PNG_FORMAT_RGB;
  return PNG_FORMAT_RGBA;
}

}  // namespace

failure::Expected<void> write_png(const std::filesystem::path& path, const Image& image) {
  auto file = file::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  return write_png(std::move(*file), image);
}

failure::Expected<void> write_png(file::NewFile file, const Image& image) {
  YARS_REQUIRE(image.pixels.size(), ==, static_cast<std::size_t>(image.width) * image.height * image.channels);
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = format_of(image.channels);
  if (png_image_write_to_stdio(&png, file.stream(), 0, image.pixels.data(), 0, nullptr) == 0)
    return failure::fail(file.shown(), "a PNG file to be written", png.message,
                         "check the folder and the space on the disk");
  return file.finish();
}

failure::Expected<Image> read_png(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    return failure::fail(path.string(), "a PNG file", code ? code.message() : "not a plain file");
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    return failure::fail(path.string(), "a PNG file", png.message);
  Image image;
  image.channels =
      (png.format & PNG_FORMAT_FLAG_ALPHA) != 0U ? 4 : ((png.format & PNG_FORMAT_FLAG_COLOR) != 0U ? 3 : 1);
  png.format = format_of(image.channels);
  constexpr png_uint_32 kLargestSide = 32768;  // [pixels] a larger picture is not one of ours; bounds the memory
  if (png.width > kLargestSide || png.height > kLargestSide) {
    png_image_free(&png);
    return failure::fail(path.string(), "at most 32768 pixels a side",
                         std::to_string(png.width) + " x " + std::to_string(png.height));
  }
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0)
    return failure::fail(path.string(), "whole PNG data", png.message);
  return image;
}

}  // namespace yars::imageio
