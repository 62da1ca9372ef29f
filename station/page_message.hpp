// Messages of a page in a browser: from the page, input events of the pilot; to the page, frames of the display as PNG,
// each whole or what changed since the frame before.
// Inputs: a text of JSON: {"event": "pb 13"}, in the text form of input_event.hpp; {"key": "ArrowUp", "down": true}, a
// key by its name in browsers (KeyboardEvent.key); {"release": true}, all keys are released. Frames as published in the
// segment, in the order of their ids.
// Outputs: events without times and number. Messages, each encoded once whatever the number of clients: a header of
// kHeaderBytes bytes, then a PNG; numbers are little-endian: id (8 bytes), base (8): id of the frame that the message
// changes, 0: none is needed; width, height of the frame (2 each); x, y of the picture in the frame (2 each); sim time
// [ms] (8).
// Errors: a text that is no such object is an Error that says what is expected.
// Threads: one for each PagePilot and each stream of frames. Source: docs/station.md#messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "databuffer/messages/pictures.hpp"
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

using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;

class FrameStream {
 public:
  static constexpr std::size_t kHeaderBytes = 32;

  // Takes the next frame. `pixels`: RGBA, width x height x 4 bytes.
  void take(const databuffer::GlassFrame& frame, std::span<const std::uint8_t> pixels);

  std::uint64_t id() const { return frame_.id; }  // of the newest frame; 0: none yet
  // Message that brings a client from frame `seen` to the newest one; nullptr: there is nothing new. A client that has
  // the frame before gets the change, any other the whole frame.
  Bytes message_after(std::uint64_t seen);

 private:
  struct Rect {
    int left, top, right, bottom;
  };
  Rect changed_part(std::span<const std::uint8_t> pixels) const;
  Bytes encode(std::uint64_t base, const Rect& part) const;

  databuffer::GlassFrame frame_{};
  std::uint64_t before_ = 0;  // id of the frame before
  std::vector<std::uint8_t> pixels_;
  Rect part_{};
  Bytes change_, whole_;
};

}  // namespace yars::station
