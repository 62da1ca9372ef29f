// `yars config check | print | convert | user`: validates a configuration; prints it as GUF (the language of the
// configuration files); converts files of the 1996 simulation to GUF; prints the user's file of defaults.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "runtime/program.hpp"
#include "runtime/user_defaults.hpp"
#ifdef YARS_HAS_GATEWAY
#include "gateway/checks/network_check.hpp"
#endif
#include "lib/file/output_file.hpp"
#include "lib/file/text_file.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/text/plain_text.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {
namespace {

struct ConfigOptions {
  std::string file;
  bool json = false;
  bool defaults = false;
  std::string markdown;  // group of forms; empty: prints a configuration
  std::string out;
};

// The positional argument, else the value of --config. Empty when neither is given.
const std::string& chosen_file(const ConfigOptions& options, const CommonOptions& common) {
  return options.file.empty() ? common.config : options.file;
}

config::LoadedConfiguration loaded(const std::string& file) {
  auto configuration = config::load_configuration(file);
  if (!configuration) throw_failure(configuration.error());
  return std::move(*configuration);
}

// Warnings about the form Network on this computer. A form of another computer is valid, so interfaces and peers that
// this one does not have give warnings alone. So does an identity that is of another host than this, if the form has no
// name. Any other fault of the identity is thrown.
std::vector<std::string> network_warnings(const radar::NetworkSettings& network) {
#ifdef YARS_HAS_GATEWAY
  constexpr const char* kRefusedHere = "the gateway would refuse this here: ";
  std::vector<std::string> warnings;
  if (auto computer = gateway::checks::check_computer(network))
    warnings = std::move(computer->warnings);
  else
    warnings.push_back(kRefusedHere + computer.error().message());
  if (network.security.empty()) return warnings;
  auto identity = gateway::checks::check_identity(network.security, network.name);
  if (!identity) throw_failure(identity.error());
  warnings.insert(warnings.end(), identity->begin(), identity->end());
  if (!network.name.empty()) return warnings;
  const auto here = gateway::checks::check_identity(network.security, gateway::checks::host_name());
  if (!here) warnings.push_back(kRefusedHere + here.error().message());
  return warnings;
#else
  return {
      "the form Network is checked by itself alone: this build has no gateway, which would check interfaces, peers" +
      std::string(network.security.empty() ? "" : " and the identity in " + network.security)};
#endif
}

void check(const ConfigOptions& options, const CommonOptions& common) {
  const std::string& file = chosen_file(options, common);
  if (file.empty()) throw CommandFailed{"yars config check: expected a GUF file, found none; name one", 2};
  auto configuration = loaded(file);
  if (configuration.network)
    for (std::string& warning : network_warnings(*configuration.network))
      configuration.warnings.push_back(std::move(warning));
  if (options.json) {
    return print_json(
        {{"file", file}, {"valid", true}, {"warnings", configuration.warnings}, {"notes", configuration.notes}});
  }
  for (const std::string& note : configuration.notes) std::printf("%s\n", note.c_str());
  for (const std::string& warning : configuration.warnings) std::printf("%s\n", warning.c_str());
  std::printf("%s: valid, %s\n", file.c_str(), text::counted(configuration.warnings.size(), "warning").c_str());
}

void print(const ConfigOptions& options, const CommonOptions& common) {
  if (!options.markdown.empty()) {
    std::fputs(config::print_markdown(options.markdown).c_str(), stdout);
    return;
  }
  const auto configuration = loaded(chosen_file(options, common));
  const auto text = options.defaults ? config::print_explained(configuration.radar)
                                     : config::print_configuration(configuration.radar);
  std::printf("; Radar model %u.\n%s", radar::kModelNumber, text.c_str());
  if (configuration.network) std::fputs(config::print_network(*configuration.network).c_str(), stdout);
}

void convert(const ConfigOptions& options, const CommonOptions& common) {
  check_file_name("--out", options.out, {".guf"});
  const std::string& file = chosen_file(options, common);
  if (file.empty()) throw CommandFailed{"yars config convert: expected a file, found none; name one", 2};
  std::error_code problem;
  if (!options.out.empty() && std::filesystem::equivalent(file, options.out, problem)) {
    throw CommandFailed{"--out: expected a file other than the input, found " + options.out, 2};
  }
  const auto converted = config::convert_configuration(file, std::filesystem::path(options.out).parent_path());
  if (!converted) throw_failure(converted.error());
  for (const std::string& warning : converted->warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  if (options.out.empty()) {
    std::fputs(converted->text.c_str(), stdout);
  } else if (const auto written = file::write_file(options.out, converted->text); !written) {
    throw_failure(written.error());
  }
}

// Prints the user's defaults in the form of their file, which scripts/start reads. A fault of the file has ended the
// program before (CommandLine::parse).
void print_user_defaults(const ConfigOptions& options) {
  const auto defaults = runtime::read_user_defaults();
  if (!defaults) throw_failure(defaults.error());
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  for (const auto& [name, value] : defaults->values) values[name] = value.value;
  const std::string path = runtime::user_defaults_path();
  if (options.json) return print_json({{"file", path}, {"exists", !defaults->file.empty()}, {"values", values}});
  std::printf("# %s\n",
              path.empty() ? "no file" : (path + (defaults->file.empty() ? " (does not exist)" : "")).c_str());
  for (const auto& [name, value] : defaults->values) std::printf("%s = %s\n", name.c_str(), value.value.c_str());
}

}  // namespace

void add_config_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command command = app.subcommand("config", "check, print and convert configurations; print user defaults");
  command.require_subcommand();
  const auto options = std::make_shared<ConfigOptions>();
  // Resolves names of installed files in the same way as --config does.
  const auto installed = [](const std::string& name) { return file::installed_file(name); };

  runtime::Command check_command = command.subcommand(
      "check", "check whether a file is valid, with its form Network and identity, and print its warnings");
  check_command.option("FILE", options->file, "GUF file")
      .value_name("FILE")
      .otherwise("the file of --config")
      .transform(installed);
  add_json_flag(check_command, options->json);
  check_command.callback([options, &common] { check(*options, common); });

  runtime::Command print_command =
      command.subcommand("print", "print the configuration that results from a file, as GUF");
  runtime::Option file = print_command.option("FILE", options->file, "GUF file");
  file.value_name("FILE").otherwise("the file of --config, else the defaults").transform(installed);
  runtime::Option defaults =
      print_command.flag("--defaults", options->defaults, "explain every slot: position, kind, range, default");
  runtime::Option markdown =
      print_command.option("--markdown", options->markdown, "group of forms: prints their slots as tables");
  markdown.one_of(config::form_groups()).excludes(file).excludes(defaults).otherwise("a configuration");
  print_command.callback([options, &common] { print(*options, common); });

  runtime::Command convert_command =
      command.subcommand("convert", "convert a file of 1996 (message syntax, old spellings) to present GUF");
  convert_command.option("FILE", options->file, "file of 1996")
      .value_name("FILE")
      .otherwise("the file of --config")
      .transform(installed);
  convert_command.option("--out", options->out, "GUF file to write").value_name("FILE").otherwise("standard output");
  convert_command.callback([options, &common] { convert(*options, common); });

  runtime::Command user_command =
      command.subcommand("user", "print the path of the user's file of defaults, and its values");
  add_json_flag(user_command, options->json);
  user_command.callback([options] { print_user_defaults(*options); });
}

}  // namespace yars::tools
