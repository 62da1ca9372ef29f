#include <png.h>

#include <cstdio>
#include <string>

#include "lib/failure/require.hpp"
#include "lib/file/new_file.hpp"
#include "lib/imageio/indexed_png.hpp"

namespace yars::imageio {

namespace {

void keep_message(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}
void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

// Leaves by longjmp when libpng meets an error: nothing here has a destructor.
bool put_image(png_structp png, png_infop info, std::FILE* file, const IndexedImage& image) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_color colours[PNG_MAX_PALETTE_LENGTH] = {};
  for (std::size_t index = 0; index < image.palette.size(); ++index)
    colours[index] = {image.palette[index][0], image.palette[index][1], image.palette[index][2]};
  png_set_PLTE(png, info, colours, static_cast<int>(image.palette.size()));
  // Numbers gain nothing from filters; little effort packs areas of one number as well as much.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 4);
  png_write_info(png, info);
  for (int row = 0; row < image.height; ++row)
    png_write_row(png, &image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width)]);
  png_write_end(png, info);
  return true;
}

}  // namespace

failure::Expected<void> write_indexed_png(const std::filesystem::path& path, const IndexedImage& image) {
  YARS_REQUIRE(image.pixels.size(), ==, static_cast<std::size_t>(image.width) * image.height);
  YARS_REQUIRE(image.palette.size(), >=, 1U);
  YARS_REQUIRE(image.palette.size(), <=, 256U);
  auto file = file::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  std::string message = "a failed write";
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, keep_message, ignore_warning);
  png_infop info = png_create_info_struct(png);
  const bool written = put_image(png, info, file->stream(), image);
  png_destroy_write_struct(&png, &info);
  if (!written)
    return failure::fail(path.string(), "a PNG file to be written", message,
                         "check the folder and the space on the disk");
  return file->finish();
}

}  // namespace yars::imageio
