// Where events come from: a window, a terminal, a script. A source knows no clock: it is told the time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "databuffer/records/input_event.hpp"

namespace yars::inputmonitor {

struct Moment {
  std::int64_t monotonic_ns = 0;  // [ns] CLOCK_MONOTONIC
  std::int64_t sim_time_ns = 0;   // [ns]
};

class EventSource {
 public:
  virtual ~EventSource() = default;

  // Sleeps until there may be something to take, at most `longest_ms`; also returns early on a signal. A source that
  // nothing can wake sleeps that long.
  virtual void wait(const Moment& moment, int longest_ms);
  // What has come until this moment, without times and number; never waits.
  virtual std::vector<databuffer::InputEvent> take(const Moment& moment) = 0;
  // What must be sent at the end, so that nothing stays held.
  virtual std::vector<databuffer::InputEvent> release() = 0;

  // The pilot is done, or the source is gone.
  virtual bool ended() const = 0;
  // Events are due by sim time: it wants to be asked once a tick.
  virtual bool follows_sim_time() const = 0;
  // For the log and for the pilot: what it reads and how to use it.
  virtual std::string description() const = 0;
};

}  // namespace yars::inputmonitor
