// Shells of input-monitor: an event source in a session, and the learning of a device at the terminal.
// Inputs: an EventSource; a device and commands on standard input.
// Outputs: events in an input lane, stamped with simulation time, CLOCK_MONOTONIC and a number; a map as GUF.
// Errors: events that do not fit into the lane are dropped and noted in the flight recorder.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "databuffer/runtime/tick_loop.hpp"
#include "databuffer/session/session.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// Runs an event source in a session: takes its events as they come, or once per tick, and pushes them into the lane.
class InputMonitorShell {
 public:
  InputMonitorShell(databuffer::Session& session, std::unique_ptr<EventSource> source, int lane);

  // Runs until the source ends or the program is stopped. In lockstep it continues to step after the source has ended,
  // because the other programs wait for it.
  void run(databuffer::TickLoop& loop);

 private:
  void run_by_ticks(databuffer::TickLoop& loop);
  void run_by_input();
  void report_notices();
  void push(const std::vector<databuffer::InputEvent>& events, const Moment& moment);

  databuffer::Session* session_;
  std::unique_ptr<EventSource> source_;
  std::size_t lane_;
  std::uint32_t number_ = 0;
};

// `input-monitor --learn PATH [--out FILE]`: prompts at the terminal, reads the device, writes the map as GUF. Needs no
// session. `file` empty: the map goes to standard output. Prompts go to standard error.
// Errors: the device cannot be read, no control was learned, the device disconnected early, the file cannot be written.
error::Expected<void> learn_device(const std::string& path, const std::string& file);

}  // namespace yars::inputmonitor
