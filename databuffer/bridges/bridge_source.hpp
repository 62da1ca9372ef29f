// Bridge that an option names, the bridge of a DIS exercise, notes of refused packets.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "databuffer/bridges/bridge.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

// What is written of refused packets: the first at once, with its reason; then one line in kQuiet that counts the rest.
// A flood fills neither the log nor the session's flight recorder.
inline constexpr geo::Duration kQuiet = geo::Duration::seconds(5.0);

class RefusalNotes {
 public:
  // The line to write, if one is due.
  std::optional<std::string> refused(const std::string& reason, geo::Duration now);
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
  std::uint64_t told_ = 0;
  std::optional<geo::Duration> written_;
};

// The aircraft and the traffic of a DIS exercise: one entity flies the aircraft, all others are kept as traffic. The
// aircraft is the one named; else the first platform of the air that is heard, until it is deactivated or silent for
// kEntityTimeout: then the next one that is heard.
class DisBridge final : public Bridge {
 public:
  explicit DisBridge(const std::optional<EntityId>& aircraft) : aircraft_(aircraft), named_(aircraft) {}

  error::Expected<std::optional<ExternalSample>> receive(memory::Bytes datagram, geo::Duration now) override;
  bool tells_traffic() const override { return true; }
  std::vector<TrackedEntity> traffic(geo::Duration now) const override { return others_.at(now); }
  std::optional<std::string> take_news() override;
  // A sender reports only what its receivers cannot work out, and else at each heartbeat.
  geo::Duration reach() const override { return kEntityTimeout; }
  bool hears_many() const override { return true; }

 private:
  void give_way(std::string_view why);

  std::optional<EntityId> aircraft_;
  bool named_;           // by the user: nobody takes its place
  geo::Duration heard_;  // of the aircraft, last
  StampOrder order_{kDisStampPeriod};
  EntityTable others_;
  std::optional<std::string> news_;
};

// From `--source KIND:...` to the bridge that it names and where its packets come from:
//   flightgear:[HOST:]PORT        jsbsim:[HOST:]PORT[,COLUMN,COLUMN...]
//   xplane:HOST:PORT              dis:[HOST:]PORT[,SITE,APP,ENTITY]
// HOST is where to listen (127.0.0.1 unless told: then nothing from other machines is heard; 0.0.0.0 for all), for
// X-Plane the machine to ask. PORT 1 to 65535; 0, where it listens, is any free one. COLUMNs as JSBSim's labels name
// them.
struct BridgeSource {
  std::unique_ptr<Bridge> bridge;
  std::string name;  // the kind
  std::string host;
  std::uint16_t port = 0;
  bool requests_data = false;  // host and port are whom to ask; else where to listen
};

// Whether the text names a bridge at all.
bool names_bridge(std::string_view text);

// An error counts as bad usage.
error::Expected<BridgeSource> open_bridge(std::string_view text);

}  // namespace yars::databuffer::bridges
