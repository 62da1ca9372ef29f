// Reader for PNG files of any colour type, by libpng. The result has 8 bits per channel: gray, RGB or RGBA.
// Error: libpng cannot read the file.
#pragma once

#include <png.h>

#include <filesystem>

#include "lib/error/error.hpp"
#include "lib/imageio/png.hpp"

namespace yars::test {

inline error::Expected<imageio::Image> read_png(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    return error::fail(path.string(), "a PNG file", png.message);
  imageio::Image image;
  const bool color = (png.format & PNG_FORMAT_FLAG_COLOR) != 0U;
  const bool alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0U;
  image.channels = alpha ? 4 : (color ? 3 : 1);
  png.format = alpha ? PNG_FORMAT_RGBA : (color ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY);
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0)
    return error::fail(path.string(), "complete PNG data", png.message);
  return image;
}

}  // namespace yars::test
