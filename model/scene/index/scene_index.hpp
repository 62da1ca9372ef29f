// Index of scene files: position, heading and radius of each scene, from the user's scene argument and the file's
// header.
// Inputs: scene arguments (a file or folder with an optional position). Outputs: IndexedScene records; problems as
// sentences. Whole files are read only to check the names of parts to leave out.
// Position: given in the scene argument, else coordinates in the file's name, else the header's origin.
// Radius (reach_m): distance from the origin to the farthest corner in the header, else kUnknownReach_m.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/scene/placement/placed_scene.hpp"

namespace yars::radar {
struct Scene;
}  // namespace yars::radar

namespace yars::model::scene {

struct ScenePosition {
  geo::GeoPoint position;
  std::optional<double> heading_deg;  // true
};

// Position of the numbers LAT, LON or LAT, LON, HDG in degrees, or of a text with them and commas between them. The
// error has no subject, and is of bad usage.
error::Expected<ScenePosition> scene_position(std::span<const double> numbers);
error::Expected<ScenePosition> parse_scene_position(const std::string& text);

// Parses a scene argument: `FILE`, `FILE@LAT,LON` or `FILE@LAT,LON,HDG` in degrees; north and east are positive, HDG is
// true. The path of an existing file or folder is never split at an '@'.
// Errors: the text after the last '@' is not a position, or there is no text before the '@'.
error::Expected<radar::Scene> parse_scene(const std::string& text);

// Parses `texts` by parse_scene() and adds the scenes. Then adds each of `names` (parts to leave out) to Scene::without
// of every scene that is a folder, and of every scene that is a file with a matching part. In the files of a folder the
// names are looked for when a file is loaded.
// Errors: a text that is not a scene argument, an unreadable file, names but no scene, an empty name. A name that
// matches nothing in any file is an error if no scene is a folder.
error::Expected<void> add_scenes(std::vector<radar::Scene>& scenes, const std::vector<std::string>& texts,
                                 const std::vector<std::string>& names);

// Coordinates in `name`, a file's name without its folder, in degrees_minutes_seconds: N35_44_51W121_30_2.flt. Nullopt
// if the name has no coordinates.
std::optional<geo::GeoPoint> position_in_name(const std::string& name);

// [m] Radius of a scene whose file's header lacks the origin or a corner. A map that overlaps such a scene only beyond
// this radius does not show it.
inline constexpr double kUnknownReach_m = 20'000.0;

struct IndexedScene {
  std::filesystem::path file;
  Placement placement;
  double reach_m = kUnknownReach_m;  // radius: distance between the header's origin and the header's farthest corner
  std::string without{};             // names of parts to leave out, as in radar::Scene::without
};

// Files of scenes, and one sentence about each that cannot be used.
struct SceneIndex {
  std::vector<IndexedScene> scenes;
  std::vector<std::string> problems;
};

// OpenFlight files of a folder (.flt in either case), sorted by name. Empty if the folder cannot be read.
std::vector<std::filesystem::path> scene_files_in(const std::filesystem::path& folder);

// Indexes scenes. A folder is replaced by its .flt files, sorted by name. Unusable files in folders, and links that
// lead out of their folder, are skipped and reported in `problems`. Errors: a scene that is a single file is unusable,
// or a name to leave out matches none of its parts; a folder has no .flt file.
error::Expected<std::vector<IndexedScene>> index_scenes(const std::vector<radar::Scene>& scenes,
                                                        std::vector<std::string>& problems);

}  // namespace yars::model::scene
