// Feed between the segment and the pages: frames of the display and state of the set to the pages, the pilot's events
// to the segment.
// Inputs: published frames, radar state, model status, advice; events of the pages.
// Outputs: messages for the pages; input events in an input lane.
// Errors: invalid records are refused and noted; the last valid one stays. A full input lane drops the event, with a
//   warning.
// Threads: one.
// Source: docs/station.md#messages.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/session/session.hpp"
#include "databuffer/session/validated.hpp"
#include "display/symbology/plan_view.hpp"
#include "runtime/pilot_link.hpp"
#include "station/frame_stream.hpp"

namespace yars::station {

using Text = std::shared_ptr<const std::string>;

class StationFeed {
 public:
  // Error: no input lane is free.
  static error::Expected<StationFeed> create(databuffer::Session& session);

  // Looks for news in the segment. True if there are any.
  bool refresh();
  FrameStream& frames() { return frames_; }
  // The newest state as a message; its number counts up with each new text.
  const Text& state() const { return state_text_; }
  std::uint64_t state_number() const { return state_number_; }
  void send(const databuffer::InputEvent& event) { lane_.send(event); }

 private:
  StationFeed(databuffer::Session& session, runtime::InputLane lane) : session_(&session), lane_(std::move(lane)) {}
  bool refresh_frame(std::int64_t now_ns);
  bool refresh_state(std::int64_t now_ns);
  std::string state_message() const;

  databuffer::Session* session_;
  runtime::InputLane lane_;
  FrameStream frames_;
  std::uint64_t frame_id_ = 0;  // of the last frame that was read, valid or not
  std::vector<std::uint8_t> pixels_;
  std::int64_t frame_ns_ = 0;  // CLOCK_MONOTONIC when the newest frame was read; 0: none
  display::DisplayInput input_;
  databuffer::Validated<databuffer::RadarState> state_;
  databuffer::Validated<databuffer::ModelStatus> model_;
  databuffer::Validated<databuffer::PilotAdvice> advice_;
  Text state_text_;
  std::uint64_t state_number_ = 0;
  std::int64_t next_state_ns_ = 0;
};

}  // namespace yars::station
