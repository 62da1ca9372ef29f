// Loader of configuration files, in GUF or in the message syntax of 1996.
// Inputs: a path, whose includes are read too; or a text in memory, without includes.
// Outputs: the typed configuration that every role reads; or one file of modern GUF; warnings.
// Errors: an Error with file, line and column, what was expected and what was found.
// Limits: 8 nested files, 64 includes, 1 MiB a file; includes stay inside the folder of the first file.
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
  std::vector<std::string> warnings;  // old spellings, unknown and ignored forms, unused slots
};

// The configuration of a file. An empty path gives the built-in defaults.
error::Expected<LoadedConfiguration> load_configuration(const std::filesystem::path& path);

// The same from a text in memory. Messages use `name` as its file name.
error::Expected<LoadedConfiguration> load_configuration_text(std::string_view text, const std::string& name);

// As load_configuration(); logs the warnings.
error::Expected<radar::RadarConfiguration> load_program_configuration(const std::filesystem::path& path);

// A configuration as one GUF file in the modern spelling: messages translated, includes inserted, old names replaced.
// It makes the same configuration as the original. Slots that the original omits stay omitted; comments are lost.
struct ConvertedConfiguration {
  std::string text;
  std::vector<std::string> warnings;  // of the original
};

// Converts a file. Paths in the text are made relative to `folder`, where the text will be stored; empty: the current
// folder. Also an error: the text exceeds the limits of one file.
error::Expected<ConvertedConfiguration> convert_configuration(const std::filesystem::path& path,
                                                              const std::filesystem::path& folder);

// The same from a text in memory. Messages use `name` as its file name.
error::Expected<ConvertedConfiguration> convert_configuration_text(std::string_view text, const std::string& name);

}  // namespace yars::config
