// The subcommands of `yars scene`. Each function registers one of them with CLI11.
// Errors: a callback that fails throws CommandFailed (tools/command/command.hpp).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "model/scene/openflight/node_tree.hpp"

namespace yars::tools {

void add_scene_generate(CLI::App& scene);
void add_scene_info(CLI::App& scene);
void add_scene_image(CLI::App& scene);

// Adds the option --without of `info` and `image`: names of scene parts to leave out.
void add_without(CLI::App& command, std::vector<std::string>& names);
// Filter that leaves out these names; `*` and `?` are wildcards.
model::scene::NameFilter name_filter(const std::vector<std::string>& names);

}  // namespace yars::tools
