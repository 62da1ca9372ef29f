// Shell of input-monitor: feeds the events of a source into an input lane of a session. Without a session (--learn) it
// reads the device and the keyboard, shows the dialogue (Learning), and writes the map as GUF.
// Inputs: an EventSource. Of --learn: a device, a FIFO or a file; keys on standard input, without echo on a terminal.
// Outputs: events in an input lane, with sim time [ns] and CLOCK_MONOTONIC time [ns] at which each was taken from its
//   source, and a sequence number; the caption of a tour. A live session's log says why an event was without effect or
//   refused, and what to do. Of --learn: the dialogue on standard error; the map in `file`, on standard output if that
//   is empty.
// Errors: an event for a full lane is dropped, which log and flight recorder note. Of --learn: the device cannot be
//   read; no control was learned; the file cannot be written, then the map goes to standard output; the device was
//   disconnected, and nobody can type that it is to be waited for.
// Source of --learn: docs/hardware.md#learning-a-map
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::inputmonitor {

// Runs an event source in a session and pushes its events into the input lane `lane`.
// In lockstep, or with a source that follows sim time, events are pushed once per tick; else on arrival.
class InputMonitorShell {
 public:
  InputMonitorShell(databuffer::Session& session, std::unique_ptr<EventSource> source, int lane);

  // Runs until the source ends or the program is stopped. In lockstep the shell steps on after the source has ended,
  // because the other programs wait for it.
  void run(runtime::TickLoop& loop);

 private:
  void run_by_ticks(runtime::TickLoop& loop);
  void run_by_input();
  void report_notices();
  // Hands the source what the state machine has applied, and publishes the source's caption. Only for a source with
  // captions.
  void observe();
  void publish_caption();
  void report_idle_event();
  void push(const std::vector<databuffer::InputEvent>& events, const Moment& moment);

  databuffer::Session* session_;
  std::unique_ptr<EventSource> source_;
  std::size_t lane_;
  std::uint32_t number_ = 0;
  std::uint64_t applied_cursor_ = 0;                  // applied event to read next
  std::optional<databuffer::Caption> caption_shown_;  // caption in the segment; nullopt: none
  std::array<databuffer::InputEvent, 16> recent_{};   // events pushed last; event n has index n mod 16
  databuffer::Validated<databuffer::PilotAdvice> advice_;
  std::uint64_t idle_count_ = 0;  // PilotAdvice::idle_count that was reported last
};

// `session`: name for the commands that the dialogue advises at its end.
error::Expected<void> learn_device(const std::string& path, const std::string& file, const std::string& session);

}  // namespace yars::inputmonitor
