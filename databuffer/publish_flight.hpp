// What a flight model says at a tick goes into its lane: stamped with the tick's time and epoch, nav first, so that
// whoever sees the new ownship finds the nav that goes with it.
#pragma once

#include <cstddef>

#include "databuffer/flight/flight_model.hpp"
#include "databuffer/session_layout.hpp"
#include "databuffer/tick_loop.hpp"

namespace yars::databuffer {

inline void publish_flight(SessionLayout& layout, std::size_t lane, const TickLoop::Due& due,
                           flight::FlightSample sample) {
  sample.ownship.source_time_ns = sample.nav.source_time_ns = due.sim_time_ns;
  sample.ownship.epoch = sample.nav.epoch = due.clock.epoch;
  layout.nav[lane].publish(sample.nav);
  layout.ownship[lane].publish(sample.ownship);
}

}  // namespace yars::databuffer
