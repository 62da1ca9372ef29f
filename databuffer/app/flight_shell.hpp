// Shells of flight-model: a flight model or a program outside publishes ownship and nav into its lane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/app/udp_socket_shell.hpp"
#include "databuffer/bridges/bridge.hpp"
#include "databuffer/bridges/bridge_source.hpp"
#include "databuffer/bridges/external_flight.hpp"
#include "databuffer/flight/motion.hpp"
#include "databuffer/flight/source_reader.hpp"
#include "databuffer/runtime/tick_loop.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"

namespace yars::databuffer {

// What a flight model says at a tick goes into its lane: stamped with the tick's time and epoch, nav first, so that
// whoever sees the new ownship finds the nav that goes with it.
inline void publish_flight(SessionLayout& layout, std::size_t lane, const TickLoop::Due& due,
                           flight::FlightSample sample) {
  sample.ownship.source_time_ns = sample.nav.source_time_ns = due.sim_time_ns;
  sample.ownship.epoch = sample.nav.epoch = due.clock.epoch;
  layout.nav[lane].publish(sample.nav);
  layout.ownship[lane].publish(sample.ownship);
}

// A flight model in a session: steps it by sim time and publishes ownship and nav into its lane.
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

// A program outside that flies the aircraft of a session: takes its packets, and publishes ownship and nav at the ticks
// while it is heard. It flies by its own clock, whatever the session's does: while the session is frozen it flies on,
// and the radar finds it elsewhere afterwards, which is a new epoch; a rate other than 1 changes nothing for it; a
// reset or repositioning is for the program itself to do. When nothing has come within the bridge's reach, nothing is
// published: the lane goes stale, another takes over, and this one comes back with the packets. Traffic that it tells
// of goes into the session's, unless another program has claimed that.

// Of a tick; more waits for the next, and what does not fit into the kernel's queue is dropped: a flood stalls no tick.
inline constexpr std::size_t kMaxDatagramsATick = 256;

// Opens the socket that the source needs.
error::Expected<UdpSocket> open_socket(const bridges::BridgeSource& source);

class BridgeShell {
 public:
  // `lane` is the ownship lane claimed.
  BridgeShell(Session& session, bridges::BridgeSource source, UdpSocket socket, int lane);
  BridgeShell(const BridgeShell&) = delete;
  BridgeShell& operator=(const BridgeShell&) = delete;
  ~BridgeShell();

  void step(const TickLoop::Due& due);

 private:
  void begin_epoch(const ClockState& clock);
  void ask();
  void receive();
  void take(memory::Bytes datagram, const bridges::Sender& from, std::int64_t received_ns);
  void hold_to_who_answers(const bridges::Sender& from);
  void let_go_of_the_silent();
  void refuse(const std::string& reason, geo::Duration now);
  void tell_losses();
  void tell_presence(bool heard);
  void publish(const TickLoop::Due& due, const flight::FlightSample& sample);
  void claim_traffic();
  void publish_traffic(const TickLoop::Due& due);

  Session* session_;
  bridges::BridgeSource source_;
  UdpSocket socket_;
  std::size_t lane_;
  bridges::ExternalFlight flight_;
  bridges::SenderGate gate_;
  bridges::RefusalNotes refusals_;
  std::uint64_t dropped_told_ = 0;
  std::int64_t latest_ns_ = 0;    // CLOCK_MONOTONIC of the newest packet: time does not go back for the flight
  bool holds_ = false;            // the socket hears the one that answered alone
  std::int64_t answered_ns_ = 0;  // CLOCK_MONOTONIC of its newest packet
  int jumps_told_ = 0;
  bool heard_ = false;
  std::int64_t next_publish_tick_ = 0;
  std::optional<Claim> traffic_claim_;
  geo::GeoPoint place_;  // of the aircraft, as published last
  std::int64_t next_traffic_tick_ = 0;
  std::uint32_t traffic_told_ = 0;  // entities
};

}  // namespace yars::databuffer
