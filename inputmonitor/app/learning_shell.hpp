// Shell of `input-monitor --learn PATH [--out FILE]`: reads the device and the keyboard, shows the dialogue (Learning),
// writes the map as GUF. Needs no session.
// Inputs: a device, a FIFO or a file; keys on standard input, without echo on a terminal.
// Outputs: the dialogue on standard error; the map in `file`, on standard output if `file` is empty.
// Errors: the device cannot be read; no control was learned; the file cannot be written, then the map goes to standard
// output; the device was disconnected, and nobody can type that it is to be waited for.
// Source: docs/hardware.md#learning-a-map
#pragma once

#include <string>

#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// `session`: name for the commands that the dialogue advises at its end.
error::Expected<void> learn_device(const std::string& path, const std::string& file, const std::string& session);

}  // namespace yars::inputmonitor
