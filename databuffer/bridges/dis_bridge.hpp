// The aircraft and the traffic of a DIS exercise: one entity flies the aircraft, all others are kept as traffic. The
// aircraft is the one named; else the first platform of the air that is heard, until it is deactivated or silent for
// kEntityTimeout: then the next one that is heard.
#pragma once

#include <string_view>

#include "databuffer/bridges/bridge.hpp"

namespace yars::databuffer::bridges {

class DisBridge final : public Bridge {
 public:
  explicit DisBridge(const std::optional<EntityId>& aircraft) : aircraft_(aircraft), named_(aircraft) {}

  failure::Expected<std::optional<ExternalSample>> receive(Bytes datagram, geo::Duration now) override;
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

}  // namespace yars::databuffer::bridges
