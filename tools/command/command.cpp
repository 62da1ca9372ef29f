#include "tools/command/command.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <type_traits>
#include <utility>

#include "config/schema/load.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "radar/limits.hpp"

namespace yars::tools {

runtime::Option add_terrain_option(runtime::Command command, std::string& directory) {
  runtime::Option option =
      command.option("--terrain", directory, "folder of elevation cells: DTED, HGT, DED, packs, rasters");
  return option.value_name("DIR").in_user_file();
}

void add_scene_options(runtime::Command command, ConfigurationOptions& options) {
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

void add_without(runtime::Command command, std::vector<std::string>& names) {
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

runtime::Option add_preset_option(runtime::Command command, const std::string& name, std::string& preset,
                                  const std::string& help) {
  runtime::Option option = command.option(name, preset, help);
  return option.one_of({radar::fidelity_names().begin(), radar::fidelity_names().end()});
}

radar::RadarConfiguration read_configuration(const std::string& file, const ConfigurationOptions& options) {
  auto loaded = config::load_configuration(file);
  if (!loaded) throw_failure(loaded.error());
  for (const std::string& warning : loaded->warnings) std::fprintf(stderr, "yars: %s\n", warning.c_str());
  radar::RadarConfiguration configuration = std::move(loaded->radar);
  if (!options.fidelity.empty()) configuration.fidelity = *radar::fidelity_preset(options.fidelity);
  if (!options.terrain.empty()) configuration.terrain.directory = options.terrain;
  if (auto added = model::scene::add_scenes(configuration.world.scenes, options.scenes, options.without); !added)
    throw_failure(error::usage_error(added.error()));
  return configuration;
}

namespace {

// The number of a value that may be left out.
template <class Number>
Number number_in(const std::optional<Number>&);
template <class Number>
Number number_in(const Number&);

std::string help_of(const values::Field& field) {
  return (field.unit.empty() ? "" : '[' + std::string(field.unit) + "] ") + std::string(field.purpose);
}

// Adds the option of a number.
template <class Value>
runtime::Option add_number(runtime::Command command, const std::string& name, const values::Field& field,
                           Value& value) {
  using Number = std::remove_cvref_t<decltype(number_in(value))>;
  runtime::Option option = command.option(name, value, help_of(field));
  if (field.high < values::kAny) option.range(static_cast<Number>(field.low), static_cast<Number>(field.high));
  if (!field.otherwise.empty()) option.otherwise(std::string(field.otherwise));
  return option;
}

// Adds the option of one field.
template <class Value>
void add_field(runtime::Command command, const values::Field& field, Value& value) {
  const std::string name = "--" + std::string(field.option);
  const std::string help = help_of(field);
  if constexpr (std::is_same_v<Value, bool>) {
    command.flag(value ? name + ",!--no-" + std::string(field.option) : name, value, help);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    command.option(name, value, help);
  } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
    command.option(name, value, help).repeatable().otherwise(std::string(field.otherwise));
  } else if constexpr (std::is_enum_v<Value>) {
    std::vector<std::string> names;
    for (const std::string_view one : field.values)
      if (!one.empty()) names.emplace_back(one);
    const auto text = std::make_shared<std::string>(names[static_cast<std::size_t>(value)]);
    command.option(name, *text, help).one_of(names).transform([text, names, &value](const std::string& given) {
      const auto found = std::ranges::find(names, given);
      if (found != names.end()) value = static_cast<Value>(found - names.begin());
      return given;
    });
  } else {
    add_number(command, name, field, value);
  }
}

}  // namespace

runtime::Option add_value(runtime::Command command, const std::string& name, const values::Field& field,
                          double& value) {
  return add_number(command, name, field, value);
}
runtime::Option add_value(runtime::Command command, const std::string& name, const values::Field& field,
                          std::optional<double>& value) {
  return add_number(command, name, field, value);
}

template <class Request>
void add_request_options(runtime::Command command, Request& request) {
  values::visit_fields(request, [&](const values::Field& field, auto& value) { add_field(command, field, value); });
}
template void add_request_options(runtime::Command, ScanRequest&);
template void add_request_options(runtime::Command, PatchRequest&);
template void add_request_options(runtime::Command, TerrainGeneration&);
template void add_request_options(runtime::Command, SceneGeneration&);
template void add_request_options(runtime::Command, ScanTradeRequest&);
template void add_request_options(runtime::Command, MapTradeRequest&);

CommandFailed failure_of(const error::Error& error) {
  const error::Error in_options = radar::spelled(error, [](const values::Field& field, std::string_view value) {
    return "--" + std::string(field.option) + (value.empty() || value == "true" ? "" : ' ' + std::string(value));
  });
  return {in_options.message(), error.bad_usage() ? runtime::kExitUsage : runtime::kExitFailure};
}

void throw_failure(const error::Error& error) {
  radar::fail(error);
}

Warn warn_as(const char* command) {
  return [command](const std::string& warning) {
    std::fprintf(stderr, "%s: %s\n", command, text::printable(warning).c_str());
  };
}

void fail_if_left_out(const std::vector<std::string>& left_out) {
  if (!left_out.empty())
    throw_failure({"terrain and scenes", "files that are read whole",
                   text::counted(left_out.size(), "part") + " left out, named above",
                   "repair or remove the files, or leave parts of a scene out with --scene-without"});
}

}  // namespace yars::tools
