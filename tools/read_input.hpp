// What a command read for its picture: problems are told on standard error; where nothing at all could be read the
// command fails, and where a part could not, the part is counted.
#pragma once

#include "model/scene/scene_store.hpp"
#include "model/terrain/terrain_view.hpp"
#include "tools/command.hpp"

namespace yars::tools {

// After prepare(). `command`: "yars scan"; `folder`: the terrain's; `way`: a second store of the same folder, for the
// ground between the aircraft and the picture: its problems are told, but the picture can do without it.
void check_terrain_read(const char* command, const std::string& folder, model::terrain::TerrainStore& store,
                        model::terrain::TerrainStore* way = nullptr);
void check_scenes_read(const char* command, model::scene::SceneStore& scenes);

}  // namespace yars::tools
