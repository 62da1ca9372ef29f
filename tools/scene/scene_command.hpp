// The subcommands of `yars scene`: each is one source file that adds itself.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "model/scene/openflight/node_tree.hpp"

namespace yars::tools {

void add_scene_generate(CLI::App& scene);
void add_scene_info(CLI::App& scene);
void add_scene_image(CLI::App& scene);

// The option --without of info and image, and what it asks for.
void add_without(CLI::App& command, std::vector<std::string>& names);
model::scene::NameFilter name_filter(const std::vector<std::string>& names);

}  // namespace yars::tools
