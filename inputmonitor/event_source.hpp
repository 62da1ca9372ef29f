// Where events come from: a window, a terminal, a script, a device. A source knows no clock: it is told the time.
#pragma once

#include <poll.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/records/input_event.hpp"

namespace yars::inputmonitor {

struct Moment {
  std::int64_t monotonic_ns = 0;  // [ns] CLOCK_MONOTONIC
  std::int64_t sim_time_ns = 0;   // [ns]
};

// What people should know of a source: a device that came or went.
struct News {
  bool is_trouble = false;
  std::string text;
};

class EventSource {
 public:
  virtual ~EventSource() = default;

  // Sleeps until there may be something to take, at most `longest_ms`; also returns early on a signal. A source that
  // nothing can wake sleeps that long.
  virtual void wait(const Moment& moment, int longest_ms);
  // Adds the descriptors that tell of something to take; false: only its own wait() can be told.
  virtual bool add_descriptors(std::vector<pollfd>&) const { return true; }
  // When there is something to take without any descriptor telling; none: not by itself.
  virtual std::optional<std::int64_t> deadline_ns() const { return std::nullopt; }
  // What has come until this moment, without times and number; never waits.
  virtual std::vector<databuffer::InputEvent> take(const Moment& moment) = 0;
  // What must be sent at the end, so that nothing stays held.
  virtual std::vector<databuffer::InputEvent> release() = 0;

  // The pilot is done, or the source is gone.
  virtual bool ended() const = 0;
  // Events are due by sim time: it wants to be asked once a tick.
  virtual bool follows_sim_time() const = 0;
  // What has happened to it since it was last asked.
  virtual std::vector<News> news() { return {}; }
  // For the log and for the pilot: what it reads and how to use it.
  virtual std::string description() const = 0;
};

}  // namespace yars::inputmonitor
