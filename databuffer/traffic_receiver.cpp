#include "databuffer/traffic_receiver.hpp"

#include "databuffer/records/validation.hpp"

namespace yars::databuffer {

bool TrafficReceiver::refresh(const SessionLayout& layout, std::int64_t tick, std::int64_t sim_time_ns,
                              std::uint32_t epoch) {
  refusal_.reset();
  const bool is_new = take(layout, epoch);
  if (is_new) {
    latched_.tick = tick;
    received_ns_ = sim_time_ns;
    return true;
  }
  const bool gone =
      latched_.epoch != epoch || !layout.traffic.has_value() || sim_time_ns - received_ns_ > kTrafficStaleAfter;
  if (latched_.count == 0 || !gone) return false;
  latched_ = {};
  latched_.tick = tick;
  latched_.epoch = epoch;
  return true;
}

bool TrafficReceiver::take(const SessionLayout& layout, std::uint32_t epoch) {
  if (layout.traffic.version() == version_) return false;
  Traffic traffic{};
  const auto version = layout.traffic.read(traffic);
  if (!version) return false;
  version_ = *version;
  refusal_ = why_refused(traffic);
  if (!refusal_ && traffic.epoch != epoch)
    refusal_ = "epoch: expected " + std::to_string(epoch) + ", found " + std::to_string(traffic.epoch);
  if (refusal_) {
    refusal_ = "traffic: " + *refusal_;
    ++refused_;
    return false;
  }
  latched_ = traffic;
  return true;
}

}  // namespace yars::databuffer
