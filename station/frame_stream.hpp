// Frames of the display as messages for browsers: what changed since the frame before, or the whole frame, as PNG.
// Inputs: frames as published in the segment, in the order of their ids.
// Outputs: messages, each encoded once whatever the number of clients. A message is a header of kHeaderBytes bytes,
// then
//   a PNG; numbers are little-endian:
//   id (8 bytes), base (8): id of the frame that the message changes, 0: none is needed; width, height of the frame (2
//   each); x, y of the picture in the frame (2 each); sim time [ms] (8).
// Errors: none.
// Threads: one.
// Source: docs/station.md#messages.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "databuffer/messages/pictures.hpp"

namespace yars::station {

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
