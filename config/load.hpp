// From a file in GUF or in the messages of 1996 to the typed configuration that every role reads.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lib/failure/error.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::config {

struct LoadedConfiguration {
  radar::RadarConfiguration radar;
  std::vector<std::string> warnings;  // old spellings, unknown forms that fell back, slots nobody reads
};

// An empty path gives the built-in defaults. Errors carry file, line, column and what was expected.
failure::Expected<LoadedConfiguration> load_configuration(const std::filesystem::path& path);

// The same from a text in memory, which cannot include; `name` stands for it in messages.
failure::Expected<LoadedConfiguration> load_configuration_text(std::string_view text, const std::string& name);

}  // namespace yars::config
