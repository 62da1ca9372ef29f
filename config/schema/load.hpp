// Loader of configuration files, in GUF or in the message syntax of 1996.
// Inputs: a path, with includes; or a text in memory, without includes.
// Outputs: the typed configuration of all programs, or one file of modern GUF; warnings.
// Errors: an Error with file, line and column, what was expected and what was found.
// Limits: 8 nested files; 64 includes; 1 MiB per file. An included file must be inside the folder of the first file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::config {

struct LoadedConfiguration {
  radar::RadarConfiguration radar;
  std::vector<std::string> warnings;  // old spellings, unknown forms and slots, slots without effect
};

// Loads a file. An empty path gives the built-in defaults.
error::Expected<LoadedConfiguration> load_configuration(const std::filesystem::path& path);

// Loads a text in memory. Errors and warnings call the text `name`.
error::Expected<LoadedConfiguration> load_configuration_text(std::string_view text, const std::string& name);

// Loads a file as load_configuration() does, and logs the warnings.
error::Expected<radar::RadarConfiguration> load_program_configuration(const std::filesystem::path& path);

// Configuration as one GUF file in the modern spelling. Messages are translated, includes inserted, old names replaced.
// Loading it gives the same configuration as the original. Omitted slots stay omitted; comments are lost.
struct ConvertedConfiguration {
  std::string text;
  std::vector<std::string> warnings;  // of the original
};

// Converts a file. Relative paths become relative to `folder`, in which the text will be stored (empty: current
// folder). Errors: those of load_configuration(), or the text exceeds the limits of one file.
error::Expected<ConvertedConfiguration> convert_configuration(const std::filesystem::path& path,
                                                              const std::filesystem::path& folder);

// Converts a text in memory, as if stored at the path `name`. Relative paths become relative to the folder of `name`.
error::Expected<ConvertedConfiguration> convert_configuration_text(std::string_view text, const std::string& name);

}  // namespace yars::config
