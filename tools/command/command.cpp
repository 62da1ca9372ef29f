#include "tools/command/command.hpp"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/schema/load.hpp"
#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
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

runtime::Option add_json_flag(runtime::Command command, bool& json, const std::string& help) {
  return command.flag("--json", json, help);
}

void print_json(const nlohmann::ordered_json& object, JsonLines lines) {
  const int indent = lines == JsonLines::one ? -1 : 2;
  std::printf("%s\n", object.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

bool names_file(const std::string& name) {
  return !name.empty() && name != kNoFile;
}

void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings) {
  const std::string ending = ending_of(name);
  if (!names_file(name)) return;
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) {
    // place() is never called, so the destructor of NewFile discards the file.
    if (const auto begun = file::NewFile::create(name); !begun) throw_failure(begun.error());
    return;
  }
  std::string expected = "a name that ends in " + endings.front();
  for (std::size_t i = 1; i < endings.size(); ++i) expected += (i + 1 < endings.size() ? ", " : " or ") + endings[i];
  throw_failure(error::usage_error(option, expected, name));
}

void check_folder_name(const std::string& option, const std::string& name) {
  static const std::vector<std::string> kFiles = {".png", ".tif", ".tiff", ".jp2", ".img", ".csv", ".f32", ".hgt",
                                                  ".zip", ".gz",  ".dt0",  ".dt1", ".dt2", ".ded", ".flt", ".guf"};
  const std::string ending = ending_of(name);
  if (std::find(kFiles.begin(), kFiles.end(), ending) != kFiles.end())
    throw_failure(error::usage_error(option, "the name of a folder", name + ", which ends like the name of a file"));
}

error::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little, "the file has the bytes of the array");
  return file::write_file(path, std::as_bytes(values));
}

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

namespace {

constexpr std::size_t kMaxItemsWithOwnLine = 64;  // with more items: at most one line per second

std::string duration_text(double seconds) {
  const long total_s = std::lround(seconds);
  if (total_s < 60) return std::to_string(total_s) + " s";
  return std::to_string(total_s / 60) + " min " + std::to_string(total_s % 60) + " s";
}

}  // namespace

Progress::Progress(std::size_t total)
    : terminal_(isatty(STDERR_FILENO) != 0),
      total_(total),
      start_time_(std::chrono::steady_clock::now()),
      last_print_time_(start_time_) {}

void Progress::done(const std::string& note) {
  ++done_;
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  const bool print_each = total_ <= kMaxItemsWithOwnLine && !note.empty();
  const bool completes_list = done_ == total_ && last_print_time_ != start_time_;
  if (!print_each && !completes_list && now - last_print_time_ < std::chrono::seconds(1)) return;
  last_print_time_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_time_).count();
  const double left_s = elapsed_s / static_cast<double>(done_) * static_cast<double>(total_ - done_);
  const std::string left = done_ == total_ ? "" : "  about " + duration_text(left_s) + " left";
  std::fprintf(stderr, "%zu/%zu  %s%s\n", done_, total_, note.c_str(), left.c_str());
}

ProgressLine::ProgressLine() {
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal != nullptr && std::string_view(terminal) == "dumb";
  terminal_ = !is_dumb && isatty(STDERR_FILENO) != 0;
}

void ProgressLine::show(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || (text.empty() ? !shown_ : now - last_print_time_ < std::chrono::milliseconds(100))) return;
  // Writes to the descriptor: the stream stderr escapes control characters (sanitize_terminal_output() in process.hpp).
  const std::string line = "\r\033[K" + text::printable(text);
  const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  if (written < 0) return;
  shown_ = !text.empty();
  last_print_time_ = now;
}

}  // namespace yars::tools
