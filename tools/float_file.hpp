// Rows of numbers as a file of 32-bit floats: little endian on every machine, row by row, no header.
#pragma once

#include <filesystem>
#include <span>

#include "lib/failure/error.hpp"

namespace yars::tools {

// Errors: the file cannot be written.
failure::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values);

}  // namespace yars::tools
