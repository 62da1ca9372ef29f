// Which scene files stand where, found by names and headers alone: nothing else of a file is read. A folder stands for
// the .flt files in it, in order of their names. A file's place is what is given with it, else the coordinates in its
// name, else its header's origin. How far it reaches is what its header says it covers, and 20 km where it says
// nothing. A file of a folder that cannot be used is a problem, a sentence; a file named by itself is an error, and so
// is a name to leave out that nothing in it has: to know that, all of the file is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/failure/error.hpp"
#include "model/scene/placing.hpp"

namespace yars::model::scene {

inline constexpr double kUnknownReach_m = 20'000.0;

struct IndexedScene {
  std::filesystem::path file;
  Placement placement;
  double reach_m = kUnknownReach_m;
  std::string without{};  // as radar::Scene::without
};

failure::Expected<std::vector<IndexedScene>> index_scenes(const std::vector<radar::Scene>& scenes,
                                                          std::vector<std::string>& problems);

}  // namespace yars::model::scene
