#include "gateway/exchange/lockstep_exchange.hpp"

#include <algorithm>

#include "databuffer/runtime/tick_loop.hpp"

namespace yars::gateway {

void LockstepExchange::begin_pass(Context& context) {
  const auto& lockstep = std::as_const(context.session).layout().lockstep;
  for (std::size_t role = 0; role < done_.size(); ++role)
    done_[role] = lockstep.done_tick[role].load(std::memory_order_acquire);
}

void LockstepExchange::send(Context& context) {
  for (std::size_t role = 0; role < done_.size(); ++role) {
    const bool is_ours = done_[role] > known_[role];
    if (!is_ours) continue;
    known_[role] = done_[role];
    yars_net_LockstepSample sample{};
    context.hosts.stamp(sample);
    sample.role = static_cast<std::uint32_t>(role);
    sample.done_tick = done_[role];
    for (std::size_t i = 0; i < dds::kTopicCount; ++i)
      if (context.writes(static_cast<dds::Topic>(i))) sample.written[i] = context.hosts.written()[i];
    context.write(sample);
  }
}

void LockstepExchange::receive(Context& context) {
  context.link->take<yars_net_LockstepSample>([&](const auto& sample) { receive(context, sample); });
}

void LockstepExchange::receive(Context& context, const yars_net_LockstepSample& sample) {
  if (!context.hosts.is_new(sample)) return;
  if (sample.role >= databuffer::kLockstepRoles || sample.done_tick < 0 ||
      sample.done_tick > databuffer::kLatestModelTick)
    return context.hosts.refuse(sample.host, dds::Topic::lockstep, "role or done_tick: out of range");
  // It may arrive before the host's first announcement, and is not sent again.
  const std::pair key{sample.host, sample.role};
  if (waiting_.size() >= databuffer::kMaxHosts * databuffer::kLockstepRoles)
    std::erase_if(waiting_, [&](const auto& item) { return context.hosts.find(item.first.first) == nullptr; });
  if (waiting_.contains(key) || waiting_.size() < databuffer::kMaxHosts * databuffer::kLockstepRoles)
    waiting_[key] = sample;
}

bool LockstepExchange::has_arrived(const Context& context, const yars_net_LockstepSample& sample) const {
  for (std::size_t i = 0; i < dds::kTopicCount; ++i) {
    const auto topic = static_cast<dds::Topic>(i);
    // The first four do not carry records, and lockstep has no samples but its own before this one.
    if (topic <= dds::Topic::clock_requests || topic == dds::Topic::lockstep || !context.reads(topic)) continue;
    if (context.hosts.next_from(topic, sample.host) < sample.written[i]) return false;
  }
  return true;
}

// Role after role in the order of a tick, so that one done tick may admit the next in the same pass.
void LockstepExchange::apply(Context& context, bool in_order) {
  if (!in_order) return;
  auto& lockstep = context.session.layout().lockstep;
  for (std::size_t role = 0; role < databuffer::kLockstepRoles; ++role)
    std::erase_if(waiting_, [&](const auto& item) {
      const yars_net_LockstepSample& sample = item.second;
      if (sample.role != role) return false;
      // Also of a host that has left since: its last tick still counts.
      if (!context.hosts.has_announced(sample.host) || !has_arrived(context, sample)) return false;
      if (lockstep.done_tick[role].load(std::memory_order_acquire) >= sample.done_tick) return true;
      if (!others_are_done(lockstep, role, sample.done_tick)) return false;
      known_[role] = sample.done_tick;
      databuffer::complete_tick(lockstep, role, sample.done_tick);
      return true;
    });
}

// A role waits for its predecessor alone. That one's done tick may arrive here before those of roles on further hosts
// whose records it has read: of the roles before it in this tick, and of those after it in the last tick.
bool LockstepExchange::others_are_done(const databuffer::Lockstep& lockstep, std::size_t role, std::int64_t tick) {
  const std::uint32_t roles = lockstep.roles.load(std::memory_order_relaxed);
  for (std::size_t other = 0; other < databuffer::kLockstepRoles; ++other) {
    const bool takes_part = other != role && (roles >> other & 1U) != 0;
    const std::int64_t needed = other < role ? tick : tick - 1;
    if (takes_part && lockstep.done_tick[other].load(std::memory_order_acquire) < needed) return false;
  }
  return true;
}

}  // namespace yars::gateway
