// PNG in and out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "lib/failure/error.hpp"

#include "lib/file/new_file.hpp"

namespace yars::imageio {

// Rows top to bottom, channels 1 (gray), 3 (RGB) or 4 (RGBA), 8 bits each, no padding.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint8_t> pixels;
};

// An error: the file cannot be written (lib/file/new_file.hpp).
failure::Expected<void> write_png(const std::filesystem::path& path, const Image& image);
failure::Expected<void> write_png(file::NewFile file, const Image& image);
failure::Expected<Image> read_png(const std::filesystem::path& path);

}  // namespace yars::imageio
