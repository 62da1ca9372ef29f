// A flight model in a session: steps it by sim time and publishes ownship and nav into its lane.
#pragma once

#include <cstdint>
#include <string>

#include "databuffer/flight/source_reader.hpp"
#include "databuffer/session.hpp"
#include "databuffer/tick_loop.hpp"

namespace yars::databuffer {

class FlightShell {
 public:
  // `lane` is the ownship lane claimed; `every_tick`: publishes each tick (lockstep) instead of at 50 Hz.
  FlightShell(Session& session, flight::FlightSource source, int lane, bool every_tick);
  void step(const TickLoop::Due& due);

 private:
  geo::Duration time_since_last(const TickLoop::Due& due) const;
  void begin_epoch(const ClockState& clock);
  // While the radar follows another source of a priority no lower, this one waits where that one is.
  void stand_by(const TickLoop::Due& due);
  // Goes on where a flight model of the same source died a moment ago: the radar's status still shows it there.
  bool resume(const TickLoop::Due& due);

  Session* session_;
  flight::FlightSource source_;
  std::size_t lane_;
  bool every_tick_;
  bool started_ = false;
  std::int64_t last_tick_ = 0;
  std::int64_t last_published_tick_ = 0;
};

}  // namespace yars::databuffer
