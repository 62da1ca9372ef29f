// Interface of the subcommands of `yars`: their registration, and helpers of their output: --json, checks of output
// names, raw float files, run times, progress reports. Each add_..._command function registers one subcommand. The
// other add_... functions register subcommands of a subcommand, or options that several subcommands share.
// Errors: a callback that fails throws radar::Failure or CommandFailed. yars_main prints its message as one line and
// returns its code. The check_... functions throw radar::Failure, before the computation starts. In JSON, text that is
// not valid UTF-8, as in a file name, is replaced. Source of the fields of JSON: docs/commands.md#json.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "radar/theatre.hpp"
#include "runtime/command_line.hpp"
#include "yars/requests.hpp"

namespace yars::model::scene {
class NameFilter;
}
namespace yars::radar {
struct RadarConfiguration;
}
namespace yars::values {
struct Field;
}

namespace yars::tools {

struct CommandFailed {
  std::string message;  // empty: yars_main prints nothing
  int code = 1;         // 1 failure, 2 bad usage; other codes are documented at the command
};

// The failure of an error: code 2 for bad usage, else 1. Fields of requests that the error names become options.
CommandFailed failure_of(const error::Error& error);
[[noreturn]] void throw_failure(const error::Error& error);  // throws radar::Failure

// Options that all subcommands share. They are parsed before any callback runs.
struct CommonOptions {
  std::string session = "default";
  std::string config;  // GUF file; empty: built-in defaults
};

// Options that replace parts of the configuration. An empty value keeps the configured value.
struct ConfigurationOptions {
  std::string terrain;               // directory of terrain cells
  std::string fidelity;              // name of a preset
  std::vector<std::string> scenes;   // FILE or FILE@LAT,LON,HDG; added to the configured scenes
  std::vector<std::string> without;  // names of objects or groups to leave out of scenes
};

// Adds --terrain, a folder of elevation cells. The user's file may set its default.
runtime::Option add_terrain_option(runtime::Command command, std::string& directory);
// Adds --scene and --scene-without.
void add_scene_options(runtime::Command command, ConfigurationOptions& options);
// Adds --without: names of objects or groups to leave out.
void add_without(runtime::Command command, std::vector<std::string>& names);
// Filter that leaves out these names; `*` and `?` are wildcards.
model::scene::NameFilter name_filter(const std::vector<std::string>& names);
// Adds an option `name` that takes the name of a fidelity preset.
runtime::Option add_preset_option(runtime::Command command, const std::string& name, std::string& preset,
                                  const std::string& help);
// The radar's configuration in `file` (empty: built-in defaults), changed by `options`. Prints the warnings about the
// file on standard error. Throws radar::Failure for a file that cannot be loaded, or a scene option that is not valid.
// Callers must include lib/radar/configuration.hpp, because RadarConfiguration is only declared here.
radar::RadarConfiguration read_configuration(const std::string& file, const ConfigurationOptions& options);

// Adds an option for each field of a request (lib/values/requests.idl).
template <class Request>
void add_request_options(runtime::Command command, Request& request);

// Adds an option or argument for a value (lib/values/fields.hpp), with its unit, limits and purpose. `name`: "--rate".
runtime::Option add_value(runtime::Command command, const std::string& name, const values::Field& field, double& value);
runtime::Option add_value(runtime::Command command, const std::string& name, const values::Field& field,
                          std::optional<double>& value);

using radar::LeftOut;
using radar::Warn;
// Prints warnings on standard error. `command`: prefix of each line, such as "yars scan".
Warn warn_as(const char* command);
// Throws radar::Failure, for code 1, if something was left out (LeftOut). Call after the results are written.
void fail_if_left_out(const std::vector<std::string>& left_out);

void add_scan_command(runtime::Command app, const CommonOptions& common);
void add_patch_command(runtime::Command app, const CommonOptions& common);
void add_trade_command(runtime::Command app, const CommonOptions& common);
void add_terrain_command(runtime::Command app, const CommonOptions& common);
void add_scene_command(runtime::Command app, const CommonOptions& common);
void add_dataset_command(runtime::Command app);
void add_config_command(runtime::Command app, const CommonOptions& common);
void add_sim_command(runtime::Command app, const CommonOptions& common);
void add_world_command(runtime::Command app, const CommonOptions& common);
void add_inject_command(runtime::Command app, const CommonOptions& common);
void add_note_command(runtime::Command app, const CommonOptions& common);
void add_status_command(runtime::Command app, const CommonOptions& common);
void add_watch_command(runtime::Command app, const CommonOptions& common);
void add_record_command(runtime::Command app, const CommonOptions& common);
void add_recordings_command(runtime::Command app);
void add_replay_command(runtime::Command app, const CommonOptions& common);

// Subcommands of `yars terrain`.
void add_terrain_generate(runtime::Command terrain);
void add_terrain_info(runtime::Command terrain);
void add_terrain_image(runtime::Command terrain);
void add_terrain_profile(runtime::Command terrain);
void add_terrain_dump(runtime::Command terrain);
void add_terrain_reduce(runtime::Command terrain);
void add_terrain_convert(runtime::Command terrain);
void add_terrain_cover(runtime::Command terrain);
void add_terrain_pack(runtime::Command terrain);

// Subcommands of `yars scene`.
void add_scene_generate(runtime::Command scene);
void add_scene_info(runtime::Command scene);
void add_scene_image(runtime::Command scene);

enum class JsonLines { one, many };

// Adds --json: prints one JSON object in place of text.
runtime::Option add_json_flag(runtime::Command command, bool& json,
                              const std::string& help = "print one JSON object in place of text");

// Prints the object and a line feed. JsonLines::many: indented, for people.
void print_json(const nlohmann::ordered_json& object, JsonLines lines = JsonLines::one);

// Extension of a file name in lower case with its dot, such as ".png"; empty if there is none.
std::string ending_of(const std::string& name);

// Value of an output option that means no output file.
constexpr const char* kNoFile = "none";
// Whether the value of an output option names a file: it is neither empty nor kNoFile.
bool names_file(const std::string& name);

// Requires that `name` ends in one of `endings` (".png") and that a file can be created at this path. `option` names
// the command-line option in the message. A name without a file (names_file()) passes.
void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings);

// Requires a folder name. A name that ends like a file which YARS reads or writes (".png", ".dt1") is an error.
void check_folder_name(const std::string& option, const std::string& name);

// Writes 32-bit floats in the order given, little endian on every machine, without header.
// Errors: the file cannot be written.
error::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values);

// [ms] Reading of the steady clock. Only differences of two readings have a meaning.
double wall_ms();
// [ms] Processor time of all threads of this process since its start.
double processor_ms();
// The median; for an even number of values, the larger of the two middle values. Requires at least one value.
double median(std::vector<double> values);

// Progress of a long command on standard error: items done, total, estimated time left. Prints at most one line per
// second, and a line for the last item if a line precedes it. With 64 items or fewer it also prints each item that has
// a note. Prints nothing if standard error is not a terminal.
class Progress {
 public:
  explicit Progress(std::size_t total);
  // Counts one item as done. `note` describes it and may be empty.
  void done(const std::string& note);

 private:
  bool terminal_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point start_time_;
  std::chrono::steady_clock::time_point last_print_time_;
};

// One status line on standard error. New text overwrites it at most ten times a second. Prints nothing if standard
// error is not a terminal, or one that cannot erase a line (TERM=dumb). The destructor erases the line.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { show(""); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  // Empty text erases the line.
  void show(const std::string& text);

 private:
  bool shown_ = false;
  bool terminal_;
  std::chrono::steady_clock::time_point last_print_time_;
};

}  // namespace yars::tools
