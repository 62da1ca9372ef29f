// Bridge to a program outside: its protocol's interface, and which of several senders counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/bridges/dis.hpp"
#include "databuffer/bridges/external_flight.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/byte_order.hpp"

namespace yars::databuffer::bridges {

struct Sender {
  std::uint32_t address = 0;  // IPv4, the first number highest
  std::uint16_t port = 0;
  friend bool operator==(const Sender&, const Sender&) = default;
};

// Silence after which another sender may take over: as long as a lane is taken for fresh.
inline constexpr geo::Duration kSenderSilence = geo::Duration::seconds(0.5);

// Of several senders to one port, one flies the aircraft: whose report was taken last, until it has been silent for a
// while. Two programs that send to the same port by mistake would else tear the aircraft to and fro.
class SenderGate {
 public:
  bool admits(const Sender& sender, geo::Duration now) const {
    return !holder_ || *holder_ == sender || now - heard_ > kSenderSilence;
  }
  // A report of this sender was taken. True: another one than before.
  bool taken(const Sender& sender, geo::Duration now) {
    const bool is_new = holder_ != sender;
    holder_ = sender;
    heard_ = now;
    return is_new;
  }

 private:
  std::optional<Sender> holder_;
  geo::Duration heard_;
};

using Datagram = std::vector<std::byte>;

// The protocol of a program outside that flies the aircraft: what its datagrams mean, and what it is to be sent.
// Pure: no socket, no clock; `now` is any clock that does not go back.
class Bridge {
 public:
  virtual ~Bridge() = default;

  // One datagram. Nothing: understood, but no news of the aircraft (names of columns, another entity, a part of a
  // state). An error says why it is refused.
  virtual error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) = 0;

  // Who sent the datagram that receive() gets next.
  virtual void hears_from(const Sender&) {}

  // To be sent to the program at this moment; called at least once a second.
  virtual std::vector<Datagram> requests(geo::Duration) { return {}; }
  // To be sent when the bridge ends.
  virtual std::vector<Datagram> farewell() const { return {}; }

  // Whether the program tells of others than the aircraft.
  virtual bool tells_traffic() const { return false; }
  // Every entity but the aircraft, at this moment.
  virtual std::vector<TrackedEntity> traffic(geo::Duration) const { return {}; }
  // Once after each event: something for the log.
  virtual std::optional<std::string> take_news() { return std::nullopt; }

  // How long after a packet the aircraft is flown on by dead reckoning.
  virtual geo::Duration reach() const { return geo::Duration::seconds(1.0); }
  // Whether several senders are the rule (then the protocol itself tells them apart).
  virtual bool hears_many() const { return false; }
};

}  // namespace yars::databuffer::bridges
