// The terrain store that a configuration asks for: its directory, or the built-in hills when it names none.
// Errors: the directory is missing or holds no cell.
#pragma once

#include <memory>

#include "lib/failure/error.hpp"
#include "lib/radar/configuration.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

failure::Expected<std::unique_ptr<TerrainStore>> open_terrain(const radar::TerrainConfiguration& configuration);

}  // namespace yars::model::terrain
