// Parser of `--source KIND:...` for bridges; the bridge of a DIS exercise (dis.hpp); log lines of refused packets.
// Inputs: the text of --source; Entity State PDUs (dis.hpp).
// Outputs: a Bridge with the address to listen on or to request from.
// Errors: a text that names no valid bridge is a usage error (Error::bad_usage).
// Source: docs/spec/formats.md#flight-models, docs/attach.md.
#pragma once

#include <bitset>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "flightmodel/bridges/bridge.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::flightmodel::bridges {

// Interval [s] of the log lines of refused packets. The first refusal is logged at once with its reason. Further
// refusals share one line per interval, so that a flood fills neither the log nor the flight recorder.
inline constexpr geo::Duration kRefusalInterval = geo::Duration::seconds(5.0);

class RefusalNotes {
 public:
  // Counts a refusal. Returns the line to write, if one is due.
  std::optional<std::string> refused(const std::string& reason, geo::Duration now);
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
  std::uint64_t reported_ = 0;
  std::optional<geo::Duration> written_;
};

// Aircraft and traffic of one DIS exercise: the configured one, or the first that is heard, until that has been silent
// for kEntityTimeout. One entity is the aircraft, and all others are traffic. The aircraft is the configured entity.
// Without a configured entity it is the first air platform received. If that platform is deactivated or silent for
// kEntityTimeout, the next air platform received becomes the aircraft.
class DisBridge final : public Bridge {
 public:
  DisBridge(const std::optional<EntityId>& aircraft, std::optional<std::uint8_t> exercise, geo::Geoid geoid);

  // The newest sample of the aircraft in the datagram. Without one the first fault of its PDUs, if there is one.
  error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) override;
  bool has_traffic() const override { return true; }
  std::vector<TrackedEntity> traffic(geo::Duration now) const override { return traffic_.at(now); }
  std::optional<std::string> take_log_message() override;
  // A DIS sender reports an entity when its motion departs from the dead reckoning, else once per heartbeat (5 s).
  geo::Duration extrapolation_limit() const override { return kEntityTimeout; }
  bool allows_many_senders() const override { return true; }

 private:
  error::Expected<std::optional<ExternalSample>> receive_pdu(memory::Bytes pdu, geo::Duration now);
  bool is_of_exercise(const EntityState& state, geo::Duration now);
  void release_aircraft(std::string_view why);
  void tell(const std::string& news);

  geo::Geoid geoid_;
  std::optional<std::uint8_t> exercise_;
  bool exercise_is_configured_;
  geo::Duration exercise_heard_;      // last report of the exercise
  std::bitset<256> other_exercises_;  // that the log has named
  std::optional<EntityId> aircraft_;
  bool configured_;            // true: the user configured aircraft_, so no other entity becomes the aircraft
  geo::Duration last_report_;  // last report of the aircraft
  StampOrder order_{kDisStampPeriod};
  EntityTable traffic_;
  std::optional<std::string> log_message_;
};

// Result of parsing `--source`:
//   flightgear:[HOST:]PORT        jsbsim:[HOST:]PORT[,COLUMN,COLUMN...]
//   xplane:HOST:PORT              dis:[HOST:]PORT[,SITE,APP,ENTITY][,exercise=N]
// HOST is the local address to listen on: a name, an IPv4 address, or an IPv6 address in brackets. The default
// 127.0.0.1 excludes other machines; 0.0.0.0 and [::] accept all. A multicast group, as 239.1.2.3 or 239.1.2.3%eth0, is
// joined. With xplane, HOST is the machine that runs X-Plane. PORT is 1 to 65535, or 0 for any free port when
// listening. COLUMNs are named as in JSBSim's label line.
struct BridgeSource {
  std::unique_ptr<Bridge> bridge;
  std::string name;  // KIND, such as "jsbsim"
  std::string host;
  std::uint16_t port = 0;
  bool requests_data = false;  // true: host and port receive requests; false: they are the address to listen on
};

// True if the text before the first colon is the name of a bridge.
bool names_bridge(std::string_view text);

// Parses the text and makes the bridge that it names. Each error is a usage error (Error::bad_usage).
error::Expected<BridgeSource> open_bridge(std::string_view text);

}  // namespace yars::flightmodel::bridges
