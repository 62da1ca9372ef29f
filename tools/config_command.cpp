// yars config check | print: what a GUF file says, and what can be said in one.
#include <cstdio>
#include <memory>

#include "config/load.hpp"
#include "config/print.hpp"
#include "tools/command.hpp"

namespace yars::tools {
namespace {

struct ConfigOptions {
  std::string file;
  bool defaults = false;
  bool markdown = false;
};

// The file of the subcommand, else the one of --config.
const std::string& chosen_file(const ConfigOptions& options, const CommonOptions& common) {
  return options.file.empty() ? common.config : options.file;
}

config::LoadedConfiguration loaded(const std::string& file) {
  auto configuration = config::load_configuration(file);
  if (!configuration) give_up(configuration.error());
  return std::move(*configuration);
}

void check(const ConfigOptions& options, const CommonOptions& common) {
  const std::string& file = chosen_file(options, common);
  if (file.empty()) throw CommandFailed{"yars config check: expected a GUF file, found none; name one", 2};
  const auto configuration = loaded(file);
  for (const std::string& warning : configuration.warnings) std::printf("%s\n", warning.c_str());
  std::printf("%s: valid, %zu warnings\n", file.c_str(), configuration.warnings.size());
}

void print(const ConfigOptions& options, const CommonOptions& common) {
  if (options.markdown) {
    std::fputs(config::print_markdown().c_str(), stdout);
    return;
  }
  const auto configuration = loaded(chosen_file(options, common));
  const auto text = options.defaults ? config::print_explained(configuration.radar)
                                     : config::print_configuration(configuration.radar);
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void add_config_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("config", "check and print configurations in GUF");
  command->require_subcommand(1);
  const auto options = std::make_shared<ConfigOptions>();

  auto* check_command = command->add_subcommand("check", "say whether a file is valid, and what in it is not used");
  check_command->add_option("file", options->file, "GUF file; else that of --config");
  check_command->callback([options, &common] { check(*options, common); });

  auto* print_command = command->add_subcommand("print", "the whole configuration that a file makes, as GUF");
  auto* file = print_command->add_option("file", options->file, "GUF file; else that of --config, else the defaults");
  auto* defaults =
      print_command->add_flag("--defaults", options->defaults, "explain every slot: position, kind, range, default");
  auto* markdown = print_command->add_flag("--markdown", options->markdown, "the slots of every form as tables");
  markdown->excludes(file)->excludes(defaults);
  print_command->callback([options, &common] { print(*options, common); });
}

}  // namespace yars::tools
