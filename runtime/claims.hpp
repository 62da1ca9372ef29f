// Claims of a program on a session: a role, at once or as a standby; an input lane for a pilot's actions. Running
// roles.
// Inputs: name of the session, the role, the program's name in the process table; events of a pilot; the process table.
// Outputs: the session and the claim; stamped events in the lane.
// Errors: those of Session::open(); without `standby` also a role that another process holds; no input lane is free. A
// full lane drops the event, with a warning.
// Threads: main thread only for roles; one for each InputLane.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"
#include "runtime/command_line.hpp"

namespace yars::runtime {

struct HeldRole {
  databuffer::Session session;
  databuffer::Claim claim;
};

// Adds the option --standby.
void add_standby_option(CommandLine& app, bool& standby);

// Claims the role. With `standby` waits while another process holds it, and while another host of the session does. The
// process table shows a waiting program as "NAME standby". nullopt: a stop was requested while waiting.
// `meanwhile` is called every 10 ms while it waits, to prepare for the role.
error::Expected<std::optional<HeldRole>> take_role(
    const std::string& session, databuffer::Role role, std::string_view program, bool standby,
    const std::function<void(const databuffer::Session&)>& meanwhile = {});

// Outcome of a program without --standby whose role another host of the session has taken.
tl::unexpected<error::Error> fail_yielded(databuffer::Role role);

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
