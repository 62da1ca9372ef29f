// Writes a file beside its place (`NAME.tmp`) and renames it: no reader ever meets half of one, and a failure
// leaves what was there. Folders are made as needed. Errors: the folder or the file cannot be written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "lib/failure/error.hpp"

namespace yars::model::terrain {

failure::Expected<std::filesystem::path> write_whole_file(const std::filesystem::path& path,
                                                          std::span<const std::byte> bytes);

}  // namespace yars::model::terrain
