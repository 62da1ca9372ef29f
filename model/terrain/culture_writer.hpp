// Writes a tile of culture (culture_tile.hpp), with natural colours, so that any viewer shows a map.
// Errors: the file cannot be written.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "lib/failure/error.hpp"
#include "model/terrain/culture.hpp"

namespace yars::model::terrain {

// Red, green, blue of a material; gray for codes without a meaning.
std::array<std::uint8_t, 3> material_colour(std::uint8_t code);

failure::Expected<void> write_culture(const std::filesystem::path& path, const Culture& culture);

}  // namespace yars::model::terrain
