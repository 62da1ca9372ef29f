// Link of a program with a display to the session: an input lane for the pilot's actions, and the running roles.
// Inputs: events of a pilot; the process table. Outputs: stamped events in the lane.
// Errors: no input lane is free. A full lane drops the event, with a warning.
// Threads: one for each InputLane.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"

namespace yars::runtime {

class InputLane {
 public:
  // `source`: name of the sender in `yars status`. The session must outlive the lane.
  static error::Expected<InputLane> claim(databuffer::Session& session, std::string_view source);
  void send(databuffer::InputEvent event);  // stamps the event with time and number

 private:
  InputLane(databuffer::Session& session, databuffer::Claim claim, std::string_view source)
      : session_(&session), claim_(std::move(claim)), source_(source) {}

  databuffer::Session* session_;
  databuffer::Claim claim_;
  std::string source_;
  std::uint32_t number_ = 0;
};

// True if a process with the role's name has a heartbeat that is less than 1 s old. `now_ns`: CLOCK_MONOTONIC.
bool is_alive(std::span<const databuffer::ProcessInfo> processes, databuffer::Role role, std::int64_t now_ns);

}  // namespace yars::runtime
