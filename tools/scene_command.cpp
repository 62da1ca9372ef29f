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

void add_without(CLI::App& command, std::vector<std::string>& names) {
  command.add_option("--without", names, "name of what is left out, as * and ? allow; may come again")
      ->allow_extra_args(false);
}

model::scene::NameFilter name_filter(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += name + ",";
  return model::scene::NameFilter(all);
}

}  // namespace yars::tools
