// A configuration as GUF text, and the schema as a manual.
#pragma once

#include <string>

#include "lib/radar/configuration.hpp"

namespace yars::config {

// Reads back as an equal configuration: every slot that is used, numbers in full.
std::string print_configuration(const radar::RadarConfiguration& configuration);

// The same, each slot below a comment that tells position, kind, range, default and purpose; then the forms that stand
// only inside slots, all in comments.
std::string print_explained(const radar::RadarConfiguration& configuration);

// The maps of devices alone, as a file of their own.
std::string print_devices(const radar::RadarConfiguration& configuration);

// One Markdown table a form: position, slot, value, default, purpose.
std::string print_markdown();

}  // namespace yars::config
