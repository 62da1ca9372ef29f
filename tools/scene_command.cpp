// `yars scene`: makes polygonal scenes and looks into them.
#include "tools/command.hpp"
#include "tools/scene_commands.hpp"

namespace yars::tools {

void add_scene_command(CLI::App& app, const CommonOptions& /*common*/) {
  CLI::App* scene = app.add_subcommand("scene", "polygonal scenes (OpenFlight): generate, info, image");
  scene->require_subcommand(1);
  add_scene_generate(*scene);
  add_scene_info(*scene);
  add_scene_image(*scene);
}

}  // namespace yars::tools
