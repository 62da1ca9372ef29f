// The subcommands of `yars scene`: each is one source file that adds itself.
#pragma once

#include <CLI/CLI.hpp>

namespace yars::tools {

void add_scene_generate(CLI::App& scene);
void add_scene_info(CLI::App& scene);
void add_scene_image(CLI::App& scene);

}  // namespace yars::tools
