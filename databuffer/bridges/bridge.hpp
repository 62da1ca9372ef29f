// The protocol of a program outside that flies the aircraft: what its datagrams mean, and what it is to be sent.
// Pure: no socket, no clock; `now` is any clock that does not go back.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/bridges/byte_order.hpp"
#include "databuffer/bridges/entity_table.hpp"
#include "databuffer/bridges/external_sample.hpp"
#include "databuffer/bridges/sender_gate.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

using Datagram = std::vector<std::byte>;

class Bridge {
 public:
  virtual ~Bridge() = default;

  // One datagram. Nothing: understood, but no news of the aircraft (names of columns, another entity, a part of a
  // state). An error says why it is refused.
  virtual failure::Expected<std::optional<ExternalSample>> receive(Bytes datagram, geo::Duration now) = 0;

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
