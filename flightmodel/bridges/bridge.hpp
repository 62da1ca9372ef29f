// Bridge: decoder and encoder of the protocol by which an external program flies the aircraft. SenderGate: choice
// of one sender among several.
// Inputs: datagrams with sender and arrival time.
// Outputs: validated samples of the aircraft, other entities (traffic), datagrams to send.
// Errors: a refused datagram returns an Error with the reason.
// Threads: one thread per object. A Bridge opens no socket and reads no clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flightmodel/bridges/dis.hpp"
#include "flightmodel/bridges/external_flight.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/byte_order.hpp"

namespace yars::flightmodel::bridges {

struct Sender {
  std::string address;  // IPv4 or IPv6 in numbers, as in 127.0.0.1 or fe80::1%eth0
  std::uint16_t port = 0;
  friend bool operator==(const Sender&, const Sender&) = default;
};

// Silence [s] after which another sender may take over. It equals the time for which the aircraft's state in a
// lane counts as fresh.
inline constexpr geo::Duration kSenderSilence = geo::Duration::seconds(0.5);

// Lets one sender at a time fly the aircraft: the sender of the last accepted report, until that sender has been silent
// for kSenderSilence. Without this rule, two programs that send to one port by mistake would make the aircraft jump.
class SenderGate {
 public:
  bool admits(const Sender& sender, geo::Duration now) const {
    return !holder_ || *holder_ == sender || now - last_report_ > kSenderSilence;
  }
  // Records an accepted report of this sender. True: the sender differs from the previous one.
  bool taken(const Sender& sender, geo::Duration now) {
    const bool is_new = holder_ != sender;
    holder_ = sender;
    last_report_ = now;
    return is_new;
  }

 private:
  std::optional<Sender> holder_;
  geo::Duration last_report_;
};

using Datagram = std::vector<std::byte>;

// Interface of one protocol. `now` is the time of any clock that does not go back.
class Bridge {
 public:
  virtual ~Bridge() = default;

  // Decodes one datagram. nullopt: valid, but no new sample of the aircraft (column names, another entity, part of a
  // state). An error holds the reason for the refusal.
  virtual error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) = 0;

  // Sets the sender of the datagram that the next receive() gets.
  virtual void set_sender(const Sender&) {}

  // Datagrams to send to the external program now. Call at least once a second.
  virtual std::vector<Datagram> requests(geo::Duration) { return {}; }
  // Datagrams to send when the bridge ends.
  virtual std::vector<Datagram> closing_datagrams() const { return {}; }

  // True if the protocol reports entities other than the aircraft.
  virtual bool has_traffic() const { return false; }
  // All entities except the aircraft, extrapolated to `now`.
  virtual std::vector<TrackedEntity> traffic(geo::Duration) const { return {}; }
  // Text for the log about an event since the last call, such as a change of the aircraft's entity. nullopt: no event.
  virtual std::optional<std::string> take_log_message() { return std::nullopt; }

  // Time after a packet during which the aircraft is dead reckoned (extrapolated).
  virtual geo::Duration extrapolation_limit() const { return geo::Duration::seconds(1.0); }
  // True if several senders are normal, because the packets of the protocol identify their entity.
  virtual bool allows_many_senders() const { return false; }
};

}  // namespace yars::flightmodel::bridges
