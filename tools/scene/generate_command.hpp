// `yars scene generate`: generation, which the Python module shares.
// Inputs: path, request and position of a made-up scene. Outputs: one OpenFlight file.
// Errors: the function throws radar::Failure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "lib/parallel/thread_pool.hpp"
#include "model/scene/index/scene_index.hpp"
#include "yars/requests.hpp"

namespace yars::tools {

struct SceneFile {
  std::uint64_t triangles = 0;
  std::size_t bytes = 0;
};

// Generates the scene and writes the file, with the folders that it needs. Progress goes to standard error if that is a
// terminal. Without a heading in `origin` the seed turns the scene.
// `goes_on` is asked between parts of the scene; throws parallel::Stopped, and writes nothing.
SceneFile generate_scene_file(const std::string& file, const SceneGeneration& request,
                              const model::scene::ScenePosition& origin, const parallel::GoesOn& goes_on = {});

}  // namespace yars::tools
