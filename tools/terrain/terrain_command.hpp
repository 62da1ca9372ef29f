// The subcommands of `yars terrain`. Each function registers one of them with CLI11.
// Errors: a callback that fails throws CommandFailed (tools/command/command.hpp).
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace yars::tools {

void add_terrain_generate(CLI::App& terrain);
void add_terrain_info(CLI::App& terrain);
void add_terrain_image(CLI::App& terrain);
void add_terrain_profile(CLI::App& terrain);
void add_terrain_dump(CLI::App& terrain);
void add_terrain_reduce(CLI::App& terrain);
void add_terrain_convert(CLI::App& terrain);
void add_terrain_pack(CLI::App& terrain);

}  // namespace yars::tools
