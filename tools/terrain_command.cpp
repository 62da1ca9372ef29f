// `yars terrain`: makes elevation databases and looks into them.
#include "tools/command.hpp"
#include "tools/terrain_commands.hpp"

namespace yars::tools {

void add_terrain_command(CLI::App& app, const CommonOptions& /*common*/) {
  CLI::App* terrain =
      app.add_subcommand("terrain", "elevation databases: generate, info, image, profile, dump, reduce, convert, pack");
  terrain->require_subcommand(1);
  add_terrain_generate(*terrain);
  add_terrain_info(*terrain);
  add_terrain_image(*terrain);
  add_terrain_profile(*terrain);
  add_terrain_dump(*terrain);
  add_terrain_reduce(*terrain);
  add_terrain_convert(*terrain);
  add_terrain_pack(*terrain);
}

}  // namespace yars::tools
