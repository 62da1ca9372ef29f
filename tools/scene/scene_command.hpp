// The subcommands of `yars scene`. Each function registers one of them.
// Errors: a callback that fails throws CommandFailed (tools/command/command.hpp).
#pragma once

#include <string>
#include <vector>

#include "databuffer/runtime/command_line.hpp"
#include "model/scene/openflight/node_tree.hpp"

namespace yars::tools {

void add_scene_generate(databuffer::Command scene);
void add_scene_info(databuffer::Command scene);
void add_scene_image(databuffer::Command scene);

// Adds the option --without of `info` and `image`: names of scene parts to leave out.
void add_without(databuffer::Command command, std::vector<std::string>& names);
// Filter that leaves out these names; `*` and `?` are wildcards.
model::scene::NameFilter name_filter(const std::vector<std::string>& names);

}  // namespace yars::tools
