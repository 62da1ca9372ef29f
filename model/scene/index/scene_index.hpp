// Scene files by position: names that users give, and what headers say.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/world.hpp"
#include "model/scene/placement/placed_scene.hpp"

namespace yars::model::scene {

// How people name a scene and where it stands: `FILE`, `FILE@LAT,LON` or `FILE@LAT,LON,HDG` in degrees, and coordinates
// in a file's name, degrees_minutes_seconds: N35_44_51W121_30_2.flt.

// Errors: what stands behind the last '@' is no place.
error::Expected<radar::Scene> parse_scene(const std::string& text);

// Adds what the texts say as parse_scene() reads it, then leaves out of every scene what has one of the names. Errors:
// a text that is none; a file that cannot be read; a name that nothing in any of the files has. What stands in a folder
// is asked for the names when it is read.
error::Expected<void> add_scenes(std::vector<radar::Scene>& scenes, const std::vector<std::string>& texts,
                                 const std::vector<std::string>& names);

// From a file's name without its folder; nothing when it holds no place.
std::optional<geo::GeoPoint> place_in_name(const std::string& name);

// Which scene files stand where, found by names and headers alone: nothing else of a file is read. A folder stands for
// the .flt files in it, in order of their names. A file's place is what is given with it, else the coordinates in its
// name, else its header's origin. How far it reaches is what its header says it covers, and 20 km where it says
// nothing. A file of a folder that cannot be used is a problem, a sentence; a file named by itself is an error, and so
// is a name to leave out that nothing in it has: to know that, all of the file is read.
inline constexpr double kUnknownReach_m = 20'000.0;

struct IndexedScene {
  std::filesystem::path file;
  Placement placement;
  double reach_m = kUnknownReach_m;
  std::string without{};  // as radar::Scene::without
};

error::Expected<std::vector<IndexedScene>> index_scenes(const std::vector<radar::Scene>& scenes,
                                                        std::vector<std::string>& problems);

}  // namespace yars::model::scene
