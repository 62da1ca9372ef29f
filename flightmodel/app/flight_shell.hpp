// Shells of flight-model. They publish ownship and nav of a flight model, or of a bridge (bridge.hpp), in one lane.
// Inputs: ticks of a TickLoop; for a bridge also UDP datagrams.
// Outputs: Ownship and Nav at 50 Hz, in lockstep at each tick; Traffic at 1 Hz from a bridge that reports it.
// Units: sim time [ns] of the session clock; a bridge extrapolates by CLOCK_MONOTONIC [ns].
// Errors: refused records and repositionings are written to the log and the flight recorder.
// Threads: one; a step never waits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"
#include "flightmodel/app/udp_socket_shell.hpp"
#include "flightmodel/bridges/bridge.hpp"
#include "flightmodel/bridges/bridge_source.hpp"
#include "flightmodel/bridges/external_flight.hpp"
#include "flightmodel/motion.hpp"
#include "flightmodel/source_reader.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::flightmodel {

// Stamps the sample with the tick's time and epoch and publishes it. Nav is published first, so that a reader of the
// new ownship finds the matching nav.
inline void publish_flight(databuffer::SessionLayout& layout, std::size_t lane, const runtime::TickLoop::Due& due,
                           FlightSample sample) {
  sample.ownship.source_time_ns = sample.nav.source_time_ns = due.sim_time_ns;
  sample.ownship.epoch = sample.nav.epoch = due.clock.epoch;
  layout.nav[lane].publish(sample.nav);
  layout.ownship[lane].publish(sample.ownship);
}

// Steps a flight model by sim time and publishes its ownship and nav.
class FlightShell {
 public:
  // `lane`: index of the claimed ownship lane. `every_tick`: publishes at each tick (lockstep) instead of at 50 Hz.
  FlightShell(databuffer::Session& session, FlightSource source, int lane, bool every_tick);
  void step(const runtime::TickLoop::Due& due);

 private:
  geo::Duration time_since_last(const runtime::TickLoop::Due& due) const;
  void begin_epoch(const databuffer::ClockState& clock);
  // While the radar uses another lane, moves this model to the ownship of that lane. Exceptions: that ownship is stale,
  // or this lane has the higher priority.
  void stand_by(const runtime::TickLoop::Due& due);
  // Continues the flight of an earlier process from the last ownship in ModelStatus (a record of the radar model).
  // Conditions: not lockstep; that ownship is from a source of the same name, in this epoch, and at most 10 s of sim
  // time old. False: not continued.
  bool resume(const runtime::TickLoop::Due& due);

  databuffer::Session* session_;
  FlightSource source_;
  std::size_t lane_;
  bool every_tick_;
  bool started_ = false;
  std::int64_t last_tick_ = 0;
  std::int64_t last_published_tick_ = 0;
};

// Maximum number of datagrams processed per tick. Further datagrams stay in the kernel's queue, which drops datagrams
// when it is full. With a larger maximum a flood of packets could delay a tick.
inline constexpr std::size_t kMaxDatagramsPerTick = 256;

// Opens the UDP socket of the source.
error::Expected<UdpSocket> open_socket(const bridges::BridgeSource& source);

// Publishes the aircraft that an external program flies, and the surface traffic that it reports.
// The external program has its own clock. The external program continues while the session is frozen, and the rate of
// the session's clock does not affect it. If the position after a freeze is too far from the one before (JumpGuard in
// receivers.hpp), the radar model begins a new epoch. The bridge refuses a repositioning, because only the external
// program can move its aircraft. Ownship and nav are no longer published when no report of the aircraft has arrived for
// longer than the extrapolation limit of the bridge. The lane is then stale, and the radar uses another lane until
// reports arrive again.
// Traffic is published unless another program has the traffic role when the bridge starts.
class BridgeShell {
 public:
  // `lane`: index of the claimed ownship lane.
  BridgeShell(databuffer::Session& session, bridges::BridgeSource source, UdpSocket socket, int lane);
  BridgeShell(const BridgeShell&) = delete;
  BridgeShell& operator=(const BridgeShell&) = delete;
  ~BridgeShell();

  void step(const runtime::TickLoop::Due& due);

 private:
  void begin_epoch(const databuffer::ClockState& clock);
  void send_requests();
  void receive();
  void take(memory::Bytes datagram, const bridges::Sender& from, std::int64_t received_ns);
  void lock_to_responder(const bridges::Sender& from);
  void release_silent_responder();
  void refuse(const std::string& reason, geo::Duration now);
  void report_drops();
  void report_presence(bool receiving);
  void publish(const runtime::TickLoop::Due& due, const FlightSample& sample);
  void claim_traffic();
  void publish_traffic(const runtime::TickLoop::Due& due);

  databuffer::Session* session_;
  bridges::BridgeSource source_;
  UdpSocket socket_;
  std::size_t lane_;
  bridges::ExternalFlight flight_;
  bridges::SenderGate gate_;
  bridges::RefusalNotes refusals_;
  std::uint64_t reported_drops_ = 0;
  std::int64_t latest_ns_ = 0;  // arrival time of the newest packet (CLOCK_MONOTONIC); never decreases
  // The responder is the address that answers the requests. True: the socket receives only from it.
  bool locked_to_responder_ = false;
  std::int64_t last_reply_ns_ = 0;  // CLOCK_MONOTONIC of the responder's newest packet
  int reported_jumps_ = 0;
  bool receiving_ = false;
  std::int64_t next_publish_tick_ = 0;
  std::optional<databuffer::Claim> traffic_claim_;
  geo::GeoPoint position_;  // last published position of the aircraft
  std::int64_t next_traffic_tick_ = 0;
  std::uint32_t published_entities_ = 0;  // number of entities in the last published Traffic
};

}  // namespace yars::flightmodel
