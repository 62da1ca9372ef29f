// `input-monitor --learn PATH [--out FILE]`: asks on the terminal, listens to the device, writes the map as GUF. Needs
// no session.
#pragma once

#include <string>

#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

// An error when the device cannot be read, goes before anything is learned, or the file cannot be written. `file`
// empty: the map goes to standard output and all else to standard error.
failure::Expected<void> learn_device(const std::string& path, const std::string& file);

}  // namespace yars::inputmonitor
