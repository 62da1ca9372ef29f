// Input checks of `yars scan` and `yars patch`: limits of the radar, and input files that could not be read.
// Errors: the beyond_... and beneath_... functions return an Error if the input exceeds a limit, else nullopt.
//   The message names the limit, the value found and an option to change. check_..._read throw CommandFailed.
// Source: lib/radar/mapping.hpp (limits of maps).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/mapping.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "tools/command/command.hpp"

namespace yars::radar {
struct AntennaConfiguration;
}  // namespace yars::radar

namespace yars::tools {

// Limits of a patch map in level flight along the ground track, by radar::map_rejection(). `target_ground_m` [m] MSL:
// terrain elevation at the map's centre; NaN: void, counts as sea level; nullopt: not known yet, so the elevation angle
// to the target is not checked.
std::optional<error::Error> beyond_limits(const model::hrm::PatchOrder& order, const radar::MapLimits& limits,
                                          std::optional<double> target_ground_m = std::nullopt);

// Gimbal limits of a scan centred on the nose, in level flight: antenna elevation above the horizontal, and scan width
// from edge to edge.
std::optional<error::Error> beyond_gimbal(geo::Angle elevation, geo::Angle width,
                                          const radar::AntennaConfiguration& antenna);

// Checks that the aircraft is not below the ground. `ground_m` [m] MSL: terrain at its position; NaN: unknown, passes.
std::optional<error::Error> beneath_ground(geo::AltitudeMsl altitude, double ground_m);

// Takes a warning, one line without the command's name.
using Warn = std::function<void(const std::string&)>;
// Prints warnings on standard error. `command`: prefix of each line, such as "yars scan".
Warn warn_as(const char* command);

// Both check_..._read functions warn of each problem of reading; that of terrain warns of notes, too. They then count
// the files of the region, the ground that the last prepare() has loaded. If some of these files are unreadable, they
// say how many. If all are unreadable, they throw CommandFailed with code 1.

// Call after prepare() of the stores. `folder`: terrain folder, for messages. `path_store`: optional second store of
// the same folder, for the ground between aircraft and map. Problems of this store are printed, but do not make the
// command fail.
void check_terrain_read(const Warn& warn, const std::string& folder, model::terrain::TerrainStore& store,
                        model::terrain::TerrainStore* path_store = nullptr);
void check_scenes_read(const Warn& warn, model::scene::SceneStore& scenes);

// What stores lack of their files, in all regions so far. Each sentence once, in the order of the calls.
class LeftOut {
 public:
  void add(const model::terrain::TerrainStore& store);
  void add(const model::scene::SceneStore& scenes);
  const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  void add(const std::vector<std::string>& sentences);
  std::vector<std::string> sentences_;
};

// Throws CommandFailed with code 1 if something was left out (LeftOut). Call after the results are written.
void fail_if_left_out(const std::vector<std::string>& left_out);

}  // namespace yars::tools
