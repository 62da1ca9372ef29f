#include "databuffer/bridges/dis_bridge.hpp"

#include <string>
#include <utility>

namespace yars::databuffer::bridges {

failure::Expected<std::optional<ExternalSample>> DisBridge::receive(Bytes datagram, geo::Duration now) {
  if (is_other_pdu(datagram)) return std::nullopt;
  const auto state = decode_entity_state(datagram);
  if (!state) return tl::unexpected(state.error());
  if (!named_ && aircraft_ && now - heard_ > kEntityTimeout) give_way("has been silent for 12 s");
  const bool flies = state->kind == EntityKind::platform && state->domain == EntityDomain::air;
  if (!aircraft_ && flies && !state->deactivated) {
    aircraft_ = state->id;
    order_ = StampOrder(kDisStampPeriod);
    others_.forget(state->id);
    news_ = news_.value_or("") + (news_ ? "; " : "") + "the aircraft is entity " + text_of(state->id) +
            ", the first of the air that was heard";
  }
  if (state->id != aircraft_) {
    if (const auto reason = others_.update(*state, now)) return failure::fail("dis", "traffic that is news", *reason);
    return std::nullopt;
  }
  if (const auto reason = order_.why_not_news(state->stamp)) return failure::fail("dis", "a newer report", *reason);
  heard_ = now;
  if (state->deactivated) {
    if (!named_) give_way("was deactivated");
    return std::nullopt;
  }
  ExternalSample sample = state->sample;
  if (state->frozen) {
    sample.ownship.velocity_north_mps = sample.ownship.velocity_east_mps = sample.ownship.velocity_down_mps = 0.0;
    sample.rates = AttitudeRates{};
    sample.acceleration_mps2.reset();
  }
  return sample;
}

void DisBridge::give_way(std::string_view why) {
  news_ = "entity " + text_of(*aircraft_) + " " + std::string(why) + ": the next of the air that is heard flies";
  aircraft_.reset();
}

std::optional<std::string> DisBridge::take_news() {
  return std::exchange(news_, std::nullopt);
}

}  // namespace yars::databuffer::bridges
