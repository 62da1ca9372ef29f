// How people name a scene and where it stands: `FILE`, `FILE@LAT,LON` or `FILE@LAT,LON,HDG` in degrees, and coordinates
// in a file's name, degrees_minutes_seconds: N35_44_51W121_30_2.flt.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/failure/error.hpp"
#include "lib/radar/world.hpp"

namespace yars::model::scene {

// Errors: what stands behind the last '@' is no place.
failure::Expected<radar::Scene> parse_scene(const std::string& text);

// Adds what the texts say as parse_scene() reads it, then leaves out of every scene what has one of the names. Errors:
// a text that is none; a file that cannot be read; a name that nothing in any of the files has. What stands in a folder
// is asked for the names when it is read.
failure::Expected<void> add_scenes(std::vector<radar::Scene>& scenes, const std::vector<std::string>& texts,
                                   const std::vector<std::string>& names);

// From a file's name without its folder; nothing when it holds no place.
std::optional<geo::GeoPoint> place_in_name(const std::string& name);

}  // namespace yars::model::scene
