// Keys typed in a small window of its own. Keys are told by their place on an American keyboard; repeats of a held
// key are passed over, and a window that loses the keyboard lets go of everything.
#pragma once

#include <memory>
#include <string>

#include "inputmonitor/event_source.hpp"
#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

// `session` goes into the title. An error when there is no display.
failure::Expected<std::unique_ptr<EventSource>> open_window_source(const std::string& session);

}  // namespace yars::inputmonitor
