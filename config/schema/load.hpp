// Loader and converter of configuration files, which are in GUF (docs/configuration.md) or in the message syntax of
// 1996 (config/guf/messages.hpp).
// Inputs: a file with its includes; or a text in memory, of which the loader does not read the included files.
// Outputs: a RadarConfiguration, or the text of one equivalent GUF file; warnings.
// Errors: the file, the line and column of a wrong value, what was expected and what was found.
// Limits: includes nested 8 files deep, the first file counted; 64 includes; 1 MiB per file. Included files must lie in
// the folder of the first file or below it, or be files that came with YARS, included by their name alone.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/guf/parser.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/network.hpp"

namespace yars::config {

struct LoadedConfiguration {
  radar::RadarConfiguration radar;
  std::optional<radar::NetworkSettings> network;  // of the form Network; none: the file has no such form
  std::vector<std::string> warnings;  // such as: old spellings, unknown forms and slots, values without effect
  std::vector<std::string> notes;     // lists of forms, such as showers, that replace those of earlier forms
};

// The configuration of a file. An empty path gives the built-in defaults.
error::Expected<LoadedConfiguration> load_configuration(const std::filesystem::path& path);

// Like load_configuration(), but from a text in memory. Errors and warnings use `name` as the name of the file.
error::Expected<LoadedConfiguration> load_configuration_text(std::string_view text, const std::string& name);

// Faults of a GUF text in memory, for a program that words them: unknown forms and slots, and behind them the first
// value that is not valid, where the reader ends. An empty vector: none.
std::vector<Fault> faults_of_text(std::string_view text, const std::string& name);

// Like load_configuration(), but writes the warnings to the log.
error::Expected<radar::RadarConfiguration> load_program_configuration(const std::filesystem::path& path);

// A configuration, and the form Network of the gateway of this computer.
struct ProgramNetwork {
  radar::NetworkSettings network;
  radar::RadarConfiguration radar;
  std::string source;  // the file that has the form; empty: none has it, and `network` has the defaults
};

// The configuration of `configuration`, and the form Network of `network`, a file of its own; if that path is empty,
// that of the configuration, and without one the defaults. Writes the warnings of both files to the log.
// Errors: those of load_configuration(), and a file `network` without the form.
error::Expected<ProgramNetwork> load_network(const std::filesystem::path& network,
                                             const std::filesystem::path& configuration = {});

// A configuration as one GUF file: the message syntax is translated, included files are inserted, and old names are
// replaced.
// The file gives the same configuration as the original. Slots that the original omits stay omitted. Comments are lost.
struct ConvertedConfiguration {
  std::string text;
  std::vector<std::string> warnings;  // warnings about the original
};

// Converts a file. `folder` is where the caller stores the text; empty: the current folder. Relative paths change so
// that they start from `folder`. Errors: those of load_configuration(), and a text that exceeds the limits of one file.
error::Expected<ConvertedConfiguration> convert_configuration(const std::filesystem::path& path,
                                                              const std::filesystem::path& folder);

// Like convert_configuration(), but from a text in memory; the paths in it do not change, and its includes are not
// inserted. Errors and warnings use `name` as the name of the file.
error::Expected<ConvertedConfiguration> convert_configuration_text(std::string_view text, const std::string& name);

}  // namespace yars::config
