// `yars terrain generate`: generation, which the Python module shares.
// Inputs: folder and request of a made-up landscape. Outputs: files of its cells; their numbers.
// Errors: the function throws radar::Failure.
#pragma once

#include <cstddef>
#include <string>

#include "lib/parallel/thread_pool.hpp"
#include "yars/requests.hpp"

namespace yars::tools {

struct GeneratedCells {
  std::size_t land = 0, sea = 0;  // cells with land, cells with only sea
};

// Generates the landscape and writes its cells below `folder`. Progress goes to standard error if that is a terminal.
// `goes_on` is asked between rows of posts; throws parallel::Stopped, and leaves whole cells.
GeneratedCells generate_terrain_files(const std::string& folder, const TerrainGeneration& request,
                                      const parallel::GoesOn& goes_on = {});

}  // namespace yars::tools
