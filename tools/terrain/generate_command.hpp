// `yars terrain generate`: options and generation, which the Python module shares.
// Inputs: options of a made-up landscape. Outputs: files of its cells; their numbers.
// Errors: functions throw CommandFailed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "lib/parallel/thread_pool.hpp"
#include "runtime/command_line.hpp"
#include "worldgen/terrain/landscape.hpp"

namespace yars::tools {

struct TerrainGenerateOptions {
  using Default = worldgen::DefaultLandscape;
  std::string out;
  int south_deg = Default::kSouth_deg;
  int west_deg = Default::kWest_deg;
  int cells_latitude = Default::kCellsNorth;
  int cells_longitude = Default::kCellsEast;
  int level = 1;
  std::uint64_t seed = Default::kSeed;
  std::string edge = "coast";
  bool culture = true;
  std::string airfields = "paved";
  bool sea = false;
  int threads = 0;  // 0: one per core of the machine
  bool json = false;
};

struct GeneratedCells {
  std::size_t land = 0, sea = 0;  // cells with land, cells with only sea
};

void add_terrain_generate_options(runtime::Command command, TerrainGenerateOptions& options);

// Generates the landscape and writes its cells. Progress goes to standard error if that is a terminal. `goes_on` is
// asked between rows of posts; throws parallel::Stopped, and leaves whole cells.
GeneratedCells generate_terrain_files(const TerrainGenerateOptions& options, const parallel::GoesOn& goes_on = {});

}  // namespace yars::tools
