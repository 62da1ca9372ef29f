// The subcommands of `yars terrain`. Each function registers one of them.
// Errors: a callback that fails throws CommandFailed (tools/command/command.hpp).
#pragma once

#include "databuffer/runtime/command_line.hpp"

namespace yars::tools {

void add_terrain_generate(databuffer::Command terrain);
void add_terrain_info(databuffer::Command terrain);
void add_terrain_image(databuffer::Command terrain);
void add_terrain_profile(databuffer::Command terrain);
void add_terrain_dump(databuffer::Command terrain);
void add_terrain_reduce(databuffer::Command terrain);
void add_terrain_convert(databuffer::Command terrain);
void add_terrain_pack(databuffer::Command terrain);

}  // namespace yars::tools
