// Messages of a page in a browser, as input events of the pilot.
// Inputs: a text of JSON: {"event": "pb 13"}, in the text form of input_event.hpp; {"key": "ArrowUp", "down": true}, a
// key
//   by its name in browsers (KeyboardEvent.key); {"release": true}, all keys are released.
// Outputs: events without times and number.
// Errors: a text that is no such object is an Error that says what is expected.
// Threads: one for each PagePilot.
// Source: docs/station.md#messages.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "lib/error/error.hpp"

namespace yars::station {

inline constexpr std::size_t kMaxMessageBytes = 1024;

// Key with this name in browsers; Key::none for another.
databuffer::Key key_of_browser(std::string_view name);

// The pilot at one page.
class PagePilot {
 public:
  error::Expected<std::vector<databuffer::InputEvent>> events_of(std::string_view message);
  // Events that release all that is held, for a page that was closed or lost the focus. A switch that the pointer
  // pressed stays as in the window of radar-display: what was not released designates nothing.
  std::vector<databuffer::InputEvent> release_all();

 private:
  databuffer::KeyboardState keyboard_;
  bool deflected_ = false;  // by an event tdc of the page
};

}  // namespace yars::station
