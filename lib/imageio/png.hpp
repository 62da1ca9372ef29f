// PNG files in and out: gray, RGB and RGBA, and pictures with a palette.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"

namespace yars::imageio {

// Rows top to bottom, channels 1 (gray), 3 (RGB) or 4 (RGBA), 8 bits each, no padding.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint8_t> pixels;
};

// An error: the file cannot be written (lib/file/output_file.hpp).
error::Expected<void> write_png(const std::filesystem::path& path, const Image& image);
error::Expected<void> write_png(file::NewFile file, const Image& image);
error::Expected<Image> read_png(const std::filesystem::path& path);

// Pictures whose pixels are numbers with a colour each: PNG of colour type 3, in and out.
// Errors of reading: no PNG, not indexed, sides beyond `largest_side`, data that ends early or is broken. Checked
// before pixels are allocated. Of writing: the file cannot be written.

using PaletteColour = std::array<std::uint8_t, 3>;  // red, green, blue

// Rows top to bottom, a byte a pixel, no padding.
struct IndexedImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
  std::vector<PaletteColour> palette;  // 1 to 256; a pixel of a file read may be beyond it
};

// 8 bits a pixel, whatever the palette's size; written beside and renamed.
error::Expected<void> write_indexed_png(const std::filesystem::path& path, const IndexedImage& image);

// 1, 2, 4 or 8 bits a pixel, interlaced or not.
error::Expected<IndexedImage> read_indexed_png(const std::filesystem::path& path, int largest_side);

}  // namespace yars::imageio
