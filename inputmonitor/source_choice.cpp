#include "inputmonitor/source_choice.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "databuffer/records/text_file_reader.hpp"
#include "inputmonitor/script_source.hpp"
#include "inputmonitor/terminal_mode.hpp"
#include "inputmonitor/terminal_source.hpp"
#include "inputmonitor/window_source.hpp"

namespace yars::inputmonitor {

namespace {

using failure::Expected;
using SourcePointer = std::unique_ptr<EventSource>;

constexpr std::string_view kScript = "script:";

// Nothing to read from: a set in a container without display and terminal runs all the same.
class IdleSource final : public EventSource {
 public:
  std::vector<databuffer::InputEvent> take(const Moment&) override { return {}; }
  std::vector<databuffer::InputEvent> release() override { return {}; }
  bool ended() const override { return false; }
  bool follows_sim_time() const override { return false; }
  std::string description() const override {
    return "nothing: there is neither a display nor a terminal (yars inject sends events)";
  }
};

bool display_is_named() {
  constexpr std::array kVariables{"DISPLAY", "WAYLAND_DISPLAY"};
  return std::ranges::any_of(kVariables, [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  });
}

Expected<SourcePointer> open_script(const std::string& file) {
  const auto text = databuffer::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  auto script = parse_script(*text, file);
  if (!script) return tl::unexpected(script.error());
  return std::make_unique<ScriptSource>(std::move(*script), file);
}

Expected<SourcePointer> open_best(const std::string& session) {
  if (display_is_named()) {
    // A display that is named but not there is no reason to give up.
    if (auto window = open_window_source(session)) return window;
  }
  if (is_foreground_terminal(STDIN_FILENO)) return open_terminal_source();
  return std::make_unique<IdleSource>();
}

}  // namespace

Expected<SourceChoice> parse_source(std::string_view text) {
  if (text == "window") return SourceChoice{SourceKind::window, {}};
  if (text == "terminal") return SourceChoice{SourceKind::terminal, {}};
  if (text == "auto") return SourceChoice{SourceKind::automatic, {}};
  if (text.starts_with(kScript) && text.size() > kScript.size())
    return SourceChoice{SourceKind::script, std::string(text.substr(kScript.size()))};
  const std::string action = text.starts_with("evdev:") ? "evdev devices come with a later release" : "";
  return tl::unexpected(
      failure::Error{"--source", "window, terminal, script:FILE or auto", '"' + std::string(text) + '"', action, true});
}

Expected<SourcePointer> open_source(const SourceChoice& choice, const std::string& session) {
  switch (choice.kind) {
    case SourceKind::window:
      return open_window_source(session);
    case SourceKind::terminal:
      return open_terminal_source();
    case SourceKind::script:
      return open_script(choice.file);
    case SourceKind::automatic:
      break;
  }
  return open_best(session);
}

}  // namespace yars::inputmonitor
