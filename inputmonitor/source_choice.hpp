// Which source `--source TEXT` names, and opening it.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "inputmonitor/event_source.hpp"
#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

enum class SourceKind { window, terminal, script, automatic };

struct SourceChoice {
  SourceKind kind = SourceKind::automatic;
  std::string file;  // of a script
};

// window, terminal, script:FILE or auto; anything else is bad usage.
failure::Expected<SourceChoice> parse_source(std::string_view text);

// `auto` takes a window where there is a display, else the terminal where there is one, else a source that gives
// nothing and waits.
failure::Expected<std::unique_ptr<EventSource>> open_source(const SourceChoice& choice, const std::string& session);

}  // namespace yars::inputmonitor
