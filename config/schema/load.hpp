// Configuration file: read with its includes, as typed values or as one file of modern GUF.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::config {

// From a file in GUF or in the messages of 1996 to the typed configuration that every role reads.
struct LoadedConfiguration {
  radar::RadarConfiguration radar;
  std::vector<std::string> warnings;  // old spellings, unknown forms that fell back, slots nobody reads
};

// An empty path gives the built-in defaults. Errors carry file, line, column and what was expected.
error::Expected<LoadedConfiguration> load_configuration(const std::filesystem::path& path);

// The same from a text in memory, which cannot include; `name` stands for it in messages.
error::Expected<LoadedConfiguration> load_configuration_text(std::string_view text, const std::string& name);

// The configuration of a program, its warnings logged.
error::Expected<radar::RadarConfiguration> load_program_configuration(const std::filesystem::path& path);

// A configuration file as one GUF file in the modern spelling: messages translated, includes put in their place, old
// names of forms and slots replaced by today's. What the file does not say is not said; comments are lost.
// The text configures what the file does. Errors: those of load_configuration, and a text too long for one file.
struct ConvertedConfiguration {
  std::string text;
  std::vector<std::string> warnings;  // of the file that was read
};

// `folder` is where the text will stand: paths in it are relative to that. Empty: the current folder.
error::Expected<ConvertedConfiguration> convert_configuration(const std::filesystem::path& path,
                                                              const std::filesystem::path& folder);

// The same from a text in memory, which cannot include; `name` stands for it in messages.
error::Expected<ConvertedConfiguration> convert_configuration_text(std::string_view text, const std::string& name);

}  // namespace yars::config
