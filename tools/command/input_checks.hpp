// Checks before a picture is made: the radar's limits, and what could be read.
#pragma once

#include <optional>

#include "lib/error/error.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

// The radar's limits as `yars patch` and `yars scan` tell of them: which one is broken, by what numbers, and what to
// do. The limits themselves are those of the radar: lib/radar/mapping.hpp and the gimbal.

// Nothing: within them, in all that follows. A map's blind zone, gimbal in azimuth, windows and their ranges, before
// terrain is read.
std::optional<error::Error> beyond_limits(const model::hrm::PatchOrder& order,
                                          const radar::RadarConfiguration& configuration);

// The aircraft's height against the ground [m] MSL at the map's middle: the gimbal in elevation. NaN: not known.
std::optional<error::Error> beyond_depression(const model::hrm::PatchOrder& order, double target_ground_m,
                                              const radar::RadarConfiguration& configuration);

// A scan about the nose.
std::optional<error::Error> beyond_gimbal(geo::Angle elevation, geo::Angle width,
                                          const radar::AntennaConfiguration& antenna);

// An aircraft in the ground sees nothing. NaN: not known.
std::optional<error::Error> beneath_ground(geo::AltitudeMsl altitude, double ground_m);

// What a command read for its picture: problems are told on standard error; where nothing at all could be read the
// command fails, and where a part could not, the part is counted.

// After prepare(). `command`: "yars scan"; `folder`: the terrain's; `way`: a second store of the same folder, for the
// ground between the aircraft and the picture: its problems are told, but the picture can do without it.
void check_terrain_read(const char* command, const std::string& folder, model::terrain::TerrainStore& store,
                        model::terrain::TerrainStore* way = nullptr);
void check_scenes_read(const char* command, model::scene::SceneStore& scenes);

}  // namespace yars::tools
