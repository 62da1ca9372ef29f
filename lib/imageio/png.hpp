// PNG files: writer of gray, RGB and RGBA images; writer and reader of images with a palette. PNG in memory.
// Inputs: pixels of 8 bits, or the path of a regular file.
// Outputs: a file through lib/file/output_file.hpp, or an image. Rows run from top to bottom, without padding.
// Errors: a file that cannot be written; an input file that is no indexed PNG, is too large, is incomplete or is
// damaged. Each error names the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"

namespace yars::imageio {

// Image with 1 (gray), 3 (RGB) or 4 (RGBA) channels of 8 bits.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint8_t> pixels;
};

// Writes an image to a path or to a file that the caller has created. The program aborts unless the number of pixel
// bytes is width x height x channels.
error::Expected<void> write_png(const std::filesystem::path& path, const Image& image);
error::Expected<void> write_png(file::NewFile file, const Image& image);

// Pixels of 4 bytes in the memory of somebody else: red, green, blue, and a byte that is left out.
struct RgbxView {
  const std::uint8_t* pixels;
  int width, height;
  std::size_t row_bytes;  // from one row to the next
};
// Encodes an RGB image in memory, as fast as PNG allows (zlib level 1, no filter) at the cost of size. Replaces
// `bytes`, whose memory is used again. The program aborts for an image without pixels.
void encode_png(const RgbxView& image, std::vector<std::uint8_t>& bytes);

using PaletteColour = std::array<std::uint8_t, 3>;  // red, green, blue

// Image with a palette (PNG colour type 3). Each pixel is an index into the palette, one byte.
struct IndexedImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
  std::vector<PaletteColour> palette;  // 1 to 256 colours; a pixel read from a file may have an index outside it
};

// Writes 8 bits per pixel. The program aborts unless the image has width x height pixels and 1 to 256 colours.
error::Expected<void> write_indexed_png(const std::filesystem::path& path, const IndexedImage& image);

// Reads a PNG of colour type 3 with 1, 2, 4 or 8 bits per pixel, interlaced or not. A file with more than
// `max_side_pixels` columns or rows is refused before memory for its pixels is allocated.
// `memory`: a vector whose memory the pixels use as far as it suffices, for a caller that reads many files.
error::Expected<IndexedImage> read_indexed_png(const std::filesystem::path& path, int max_side_pixels,
                                               std::vector<std::uint8_t> memory = {});

}  // namespace yars::imageio
