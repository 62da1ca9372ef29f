#include "tools/command/command.hpp"

#include <utility>

#include "config/schema/load.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/openflight/node_tree.hpp"

namespace yars::tools {

databuffer::Option add_terrain_option(databuffer::Command command, std::string& directory) {
  databuffer::Option option =
      command.option("--terrain", directory, "folder of elevation cells: DTED, HGT, DED, packs, rasters");
  return option.value_name("DIR").in_user_file();
}

void add_scene_options(databuffer::Command command, ConfigurationOptions& options) {
  command.option("--scene", options.scenes, "OpenFlight file, as FILE or FILE@LAT,LON,HDG; repeatable")
      .value_name("FILE")
      .otherwise("the configuration's alone");
  command
      .option("--scene-without", options.without,
              "name of objects or groups to leave out of scenes, with the wildcards * and ?; repeatable")
      .value_name("NAME")
      .repeatable()
      .otherwise("none");
}

void add_without(databuffer::Command command, std::vector<std::string>& names) {
  command.option("--without", names, "name of objects or groups to leave out, with the wildcards * and ?; repeatable")
      .value_name("NAME")
      .repeatable()
      .otherwise("none");
}

model::scene::NameFilter name_filter(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += name + ",";
  return model::scene::NameFilter(all);
}

databuffer::Option add_preset_option(databuffer::Command command, const std::string& name, std::string& preset,
                                     const std::string& help) {
  databuffer::Option option = command.option(name, preset, help);
  return option.one_of({radar::fidelity_names().begin(), radar::fidelity_names().end()});
}

radar::RadarConfiguration read_configuration(const std::string& file, const ConfigurationOptions& options) {
  auto loaded = config::load_configuration(file);
  if (!loaded) throw_failure(loaded.error());
  for (const std::string& warning : loaded->warnings) std::fprintf(stderr, "yars: %s\n", warning.c_str());
  radar::RadarConfiguration configuration = std::move(loaded->radar);
  apply_options(options, configuration);
  return configuration;
}

void apply_options(const ConfigurationOptions& options, radar::RadarConfiguration& configuration) {
  if (!options.fidelity.empty()) configuration.fidelity = *radar::fidelity_preset(options.fidelity);
  if (!options.terrain.empty()) configuration.terrain.directory = options.terrain;
  if (options.seed) configuration.seed = *options.seed;
  if (auto added = model::scene::add_scenes(configuration.world.scenes, options.scenes, options.without); !added)
    throw_failure(error::usage_error(added.error()));
}

void add_seed_option(databuffer::Command command, ConfigurationOptions& options) {
  command.option("--seed", options.seed, "seed of the noise").otherwise("the configuration's");
}

void add_pose_options(databuffer::Command command, PoseOptions& options) {
  command.option("--lat", options.latitude_deg, "[deg] latitude of the aircraft")
      .range(kLatitudes_deg.min, kLatitudes_deg.max);
  command.option("--lon", options.longitude_deg, "[deg] longitude of the aircraft")
      .range(kLongitudes_deg.min, kLongitudes_deg.max);
  command.option("--alt-ft", options.altitude_ft, "[ft] altitude of the aircraft above mean sea level")
      .range(kAltitudes_ft.min, kAltitudes_ft.max);
  command.option("--heading", options.heading_deg, "[deg] true heading; also the ground track")
      .range(kHeadings_deg.min, kHeadings_deg.max);
}

}  // namespace yars::tools
