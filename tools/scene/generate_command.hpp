// `yars scene generate`: options and generation, which the Python module shares.
// Inputs: options of a made-up scene. Outputs: one OpenFlight file.
// Errors: functions throw CommandFailed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "lib/parallel/thread_pool.hpp"
#include "runtime/command_line.hpp"

namespace yars::tools {

struct SceneGenerateOptions {
  std::string kind = "airfield";
  std::uint64_t triangles = 20'000;
  std::uint64_t seed = 1;
  std::string origin;  // LAT,LON[,HDG] [deg]
  std::string out;
  bool json = false;
};

struct SceneFile {
  std::uint64_t triangles = 0;
  std::size_t bytes = 0;
};

void add_scene_generate_options(runtime::Command command, SceneGenerateOptions& options);

// Generates the scene and writes the file, with the folders that it needs. Progress goes to standard error if that is a
// terminal.
// `goes_on` is asked between parts of the scene; throws parallel::Stopped, and writes nothing.
SceneFile generate_scene_file(const SceneGenerateOptions& options, const parallel::GoesOn& goes_on = {});

}  // namespace yars::tools
