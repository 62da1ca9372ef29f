// Pictures whose pixels are numbers with a colour each: PNG of colour type 3, in and out.
// Errors of reading: no PNG, not indexed, sides beyond `largest_side`, data that ends early or is broken. Checked
// before pixels are allocated. Of writing: the file cannot be written.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "lib/failure/error.hpp"

namespace yars::imageio {

using PaletteColour = std::array<std::uint8_t, 3>;  // red, green, blue

// Rows top to bottom, a byte a pixel, no padding.
struct IndexedImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
  std::vector<PaletteColour> palette;  // 1 to 256; a pixel of a file read may be beyond it
};

// 8 bits a pixel, whatever the palette's size; written beside and renamed.
failure::Expected<void> write_indexed_png(const std::filesystem::path& path, const IndexedImage& image);

// 1, 2, 4 or 8 bits a pixel, interlaced or not.
failure::Expected<IndexedImage> read_indexed_png(const std::filesystem::path& path, int largest_side);

}  // namespace yars::imageio
