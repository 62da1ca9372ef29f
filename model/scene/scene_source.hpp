// How people name a scene and where it stands: `FILE`, `FILE@LAT,LON` or `FILE@LAT,LON,HDG` in degrees, and coordinates
// in a file's name, degrees_minutes_seconds: N35_44_51W121_30_2.flt.
#pragma once

#include <optional>
#include <string>

#include "lib/failure/error.hpp"
#include "lib/radar/world.hpp"

namespace yars::model::scene {

// Errors: what stands behind the last '@' is no place.
failure::Expected<radar::Scene> parse_scene(const std::string& text);

// From a file's name without its folder; nothing when it holds no place.
std::optional<geo::GeoPoint> place_in_name(const std::string& name);

}  // namespace yars::model::scene
