// The functions of yars_display.h over display/host: plain types outside, no exception leaves the library.
#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "display/host/display.hpp"
#include "display/library/yars_display.h"
#include "display/symbology/bezel.hpp"
#include "lib/text/plain_text.hpp"

struct yars_display {
  yars::display::host::Display display;
};

namespace {

using namespace yars;
using display::host::Display;
using display::host::PanelView;

constexpr int kButtons = 20;
constexpr const char* kNoDisplay = "display: expected a display that attach has returned, found NULL; see its error";

thread_local std::array<char, 1024> last_error{};

int failed(const char* reason) {
  std::snprintf(last_error.data(), last_error.size(), "%s", reason);
  return -1;
}

int failed(const error::Error& error) {
  return failed(error.message().c_str());
}

// Result of `work`; -1 and the reason if the display is NULL or if `work` throws, such as for want of memory.
template <class Handle, class Work>
int guarded(Handle* handle, const Work& work) noexcept {
  if (handle == nullptr) return failed(kNoDisplay);
  const text::DecimalPoint numbers;
  try {
    return work(handle->display);
  } catch (const std::exception& exception) {
    return failed(exception.what());
  }
}

std::string text_or(const char* text, const char* otherwise) {
  return text != nullptr ? text : otherwise;
}

PanelView view_of(const yars_panel& panel) {
  return {panel.bezel != 0, panel.lit, panel.tooltip, text_or(panel.notice, "")};
}

yars_display* attached(const char* session, const char* configuration, const char* program) {
  const text::DecimalPoint numbers;
  auto display =
      Display::attach({text_or(session, "default"), text_or(configuration, ""), text_or(program, "host display")});
  if (display) return new yars_display{std::move(*display)};
  failed(display.error());
  return nullptr;
}

}  // namespace

yars_display* yars_display_attach(const char* session, const char* configuration, const char* program) {
  try {
    return attached(session, configuration, program);
  } catch (const std::exception& exception) {
    failed(exception.what());
    return nullptr;
  }
}

void yars_display_detach(yars_display* d) {
  delete d;
}

const char* yars_display_error() {
  return last_error.data();
}

int yars_display_update(yars_display* d) {
  return guarded(d, [](Display& display) {
    display.update();
    return 0;
  });
}

int yars_display_draw(yars_display* d, yars_viewport viewport) {
  return guarded(d, [&](Display& display) {
    return display.draw({viewport.left, viewport.bottom, viewport.width, viewport.height}) ? 1 : 0;
  });
}

int yars_display_draw_panel(yars_display* d, const yars_panel* panel, yars_viewport viewport) {
  return guarded(d, [&](Display& display) {
    const PanelView view = view_of(panel != nullptr ? *panel : yars_panel{});
    return display.draw_panel(view, {viewport.left, viewport.bottom, viewport.width, viewport.height}) ? 1 : 0;
  });
}

int yars_display_show_help(yars_display* d, int on) {
  return guarded(d, [&](Display& display) {
    display.show_help(on != 0);
    return 0;
  });
}

int yars_display_show_hints(yars_display* d, int on) {
  return guarded(d, [&](Display& display) {
    display.show_hints(on != 0);
    return 0;
  });
}

int yars_display_press(yars_display* d, int button) {
  return guarded(d, [&](Display& display) {
    const auto pressed = display.press(button);
    return pressed ? 0 : failed(pressed.error());
  });
}

int yars_display_click(yars_display* d, double right, double down) {
  return guarded(d, [&](Display& display) {
    const auto clicked = display.click(right, down);
    if (!clicked) return failed(clicked.error());
    return *clicked ? 1 : 0;
  });
}

int yars_display_button_at(int bezel, double right, double down) {
  const display::PanelLayout layout{bezel != 0 ? display::kBezelBorder : 0.0F};
  const display::Point at{static_cast<float>(right) * layout.edge(), static_cast<float>(down) * layout.edge()};
  return display::button_at(layout, at).value_or(0);
}

int yars_display_describe(const yars_display* d, int button, char* text, size_t size) {
  return guarded(d, [&](const Display& display) {
    if (button < 1 || button > kButtons) return failed("display: expected a button 1 to 20");
    if (text == nullptr || size == 0) return failed("display: expected room for a text");
    std::snprintf(text, size, "%s", display.describe(button).c_str());
    return 0;
  });
}

int yars_display_note_shown(yars_display* d) {
  return guarded(d, [](Display& display) {
    display.note_shown();
    return 0;
  });
}
