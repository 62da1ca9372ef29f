#include <png.h>

#include <cstdio>
#include <memory>
#include <string>

#include "lib/imageio/indexed_png.hpp"

namespace yars::imageio {

namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};


// A PNG being read; freed whatever happens.
struct Reading {
  std::string message;
  png_structp png = nullptr;
  png_infop info = nullptr;

  Reading() {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, keep_message, ignore_warning);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
};

// Both leave by longjmp when libpng meets an error: nothing in them has a destructor.
bool take_header(const Reading& reading, std::FILE* file, int largest_side) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_init_io(reading.png, file);
  png_set_user_limits(reading.png, static_cast<png_uint_32>(largest_side), static_cast<png_uint_32>(largest_side));
  png_read_info(reading.png, reading.info);
  return true;
}
bool take_rows(const Reading& reading, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_read_image(reading.png, rows);
  png_read_end(reading.png, nullptr);
  return true;
}

std::vector<PaletteColour> palette_of(const Reading& reading) {
  png_colorp colours = nullptr;
  int count = 0;
  png_get_PLTE(reading.png, reading.info, &colours, &count);
  std::vector<PaletteColour> palette;
  for (int index = 0; index < count; ++index)
    palette.push_back({colours[index].red, colours[index].green, colours[index].blue});
  return palette;
}

}  // namespace

failure::Expected<IndexedImage> read_indexed_png(const std::filesystem::path& path, int largest_side) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    return failure::fail(path.string(), "a PNG file", code ? code.message() : "not a plain file");
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
  if (!file) return failure::fail(path.string(), "a PNG file", "a file that cannot be opened");
  const Reading reading;
  if (reading.info == nullptr) return failure::fail(path.string(), "memory for a PNG file", "none");
  if (!take_header(reading, file.get(), largest_side))
    return failure::fail(path.string(), "a PNG file of at most " + std::to_string(largest_side) + " pixels a side",
                         reading.message);
  if (png_get_color_type(reading.png, reading.info) != PNG_COLOR_TYPE_PALETTE)
    return failure::fail(path.string(), "an indexed PNG (colour type 3)",
                         "colour type " + std::to_string(png_get_color_type(reading.png, reading.info)),
                         "write numbers with a palette, not colours");
  IndexedImage image;
  image.width = static_cast<int>(png_get_image_width(reading.png, reading.info));
  image.height = static_cast<int>(png_get_image_height(reading.png, reading.info));
  image.palette = palette_of(reading);
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::vector<png_bytep> rows;
  for (int row = 0; row < image.height; ++row)
    rows.push_back(&image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width)]);
  png_set_packing(reading.png);
  png_set_interlace_handling(reading.png);
  png_read_update_info(reading.png, reading.info);
  if (!take_rows(reading, rows.data())) return failure::fail(path.string(), "whole PNG data", reading.message);
  return image;
}

}  // namespace yars::imageio
