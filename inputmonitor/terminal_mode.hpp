// A terminal that gives each byte at once, without echo, as long as this object lives; afterwards, and when the
// process is felled by a signal that can be caught, it is as it was. Ctrl-C goes on to end the program; Ctrl-Z is
// off, or a stopped program would leave the shell a terminal without echo.
#pragma once

#include <memory>

#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

class TerminalMode {
 public:
  // An error when the descriptor is no terminal, or this process is not in its foreground. One at a time.
  static failure::Expected<std::unique_ptr<TerminalMode>> enter(int descriptor);
  TerminalMode(const TerminalMode&) = delete;
  TerminalMode& operator=(const TerminalMode&) = delete;
  ~TerminalMode();

 private:
  TerminalMode() = default;
};

// Whether `enter` would find a terminal that is ours to read.
bool is_foreground_terminal(int descriptor);

}  // namespace yars::inputmonitor
