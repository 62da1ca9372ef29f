// A whole text file as one string, for the parsers of routes, tracks and scripts.
#pragma once

#include <filesystem>
#include <string>

#include "lib/failure/error.hpp"

namespace yars::databuffer {

// An error when the file cannot be opened, is a folder, or is larger than 256 MiB.
failure::Expected<std::string> read_text_file(const std::filesystem::path& path);

}  // namespace yars::databuffer
