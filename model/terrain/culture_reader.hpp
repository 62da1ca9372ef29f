// Reads a tile of culture (culture_tile.hpp). Errors: no indexed PNG, fewer than 2 or more than kMostCulturePosts
// posts a side, a code above kLargestMaterial; the message says where.
#pragma once

#include <filesystem>

#include "lib/failure/error.hpp"
#include "model/terrain/culture.hpp"

namespace yars::model::terrain {

failure::Expected<Culture> read_culture(const std::filesystem::path& path, CellPlace place);

}  // namespace yars::model::terrain
