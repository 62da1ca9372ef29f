// Keys typed in the terminal that is standard input.
#pragma once

#include <memory>

#include "inputmonitor/event_source.hpp"
#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

failure::Expected<std::unique_ptr<EventSource>> open_terminal_source();

}  // namespace yars::inputmonitor
