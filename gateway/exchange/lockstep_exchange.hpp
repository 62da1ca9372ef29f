// Lockstep over several hosts: carries the last done tick of each role to the other hosts.
// Inputs: done ticks of local roles; those of other hosts, with the numbers of the samples written up to then.
// Outputs: done ticks in the local segment, after everything has arrived here that the role, and the roles before it,
//   published in the tick. Network::lost_role: a role whose host has been gone for 10 s before the end of the run.
// Errors: a done tick that goes back, or is out of range, is refused. A host whose run has another end is named once.
// Source: docs/architecture.md#time; TickLoop (runtime/tick_loop.hpp).
#pragma once

#include "gateway/exchange/context.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::gateway {

class LockstepExchange {
 public:
  LockstepExchange() { known_.fill(-1); }
  // Reads the done ticks before the records of the tick are sent.
  void begin_pass(Context& context) {
    const auto& lockstep = context.layout().lockstep;
    for (std::size_t role = 0; role < done_.size(); ++role)
      done_[role] = lockstep.done_tick[role].load(std::memory_order_acquire);
  }

  // Sends the done ticks that begin_pass() found, after the records.
  void send(Context& context) {
    for (std::size_t role = 0; role < done_.size(); ++role) {
      if (done_[role] <= known_[role]) continue;  // of another host
      known_[role] = done_[role];
      performers_[role] = 0;
      auto sample = context.made<yars_net_LockstepSample>();
      sample.role = static_cast<std::uint32_t>(role);
      sample.done_tick = done_[role];
      sample.end = end_word(context.layout().lockstep);
      for (std::size_t i = 0; i < dds::kTopicCount; ++i)
        if (context.writes(static_cast<dds::Topic>(i))) sample.written[i] = context.hosts.written()[i];
      context.write(sample);
    }
  }

  // `in_order`: as for apply().
  void receive(Context& context, bool in_order) {
    context.take<yars_net_LockstepSample>(*this);
    apply(context, in_order);
  }
  void receive(Context& context, const yars_net_LockstepSample& sample) {
    if (!context.hosts.is_new(sample)) return;
    if (sample.role >= databuffer::kLockstepRoles || sample.done_tick < 0 ||
        sample.done_tick > databuffer::kLatestModelTick)
      return context.hosts.refuse(sample, "role or done_tick: out of range");
    // It may arrive before the host's first announcement, and is not sent again.
    if (Partner* partner = partners_.of(context.hosts, sample.host)) partner->waiting[sample.role] = sample;
  }

  // Applies the done ticks whose samples have all arrived, after those of the roles before. `in_order`: no record that
  // has arrived waits for another.
  void apply(Context& context, bool in_order) {
    // Role after role in the order of a tick, so that one done tick may admit the next in the same pass.
    for (std::size_t role = 0; in_order && role < databuffer::kLockstepRoles; ++role)
      for (auto& [host, partner] : partners_)
        if (auto& waiting = partner.waiting[role]; waiting && complete(context, partner, *waiting)) waiting.reset();
    watch_hosts(context);
  }

 private:
  static constexpr std::uint32_t kNoEnd = 0xFFFFFFFFU;
  static constexpr std::int64_t kGone_ns = 10'000'000'000;  // far longer than a cut or a stop from which a host returns
  static constexpr std::int64_t kMaxPass_ns = 500'000'000;  // a longer pause is one of this process, not of the others

  // LockstepSample::end of this host.
  static std::uint32_t end_word(const databuffer::Lockstep& lockstep) {
    const std::int64_t end_tick = lockstep.end_tick.load(std::memory_order_relaxed);
    return end_tick < 0 ? kNoEnd : static_cast<std::uint32_t>(std::min<std::int64_t>(end_tick, kNoEnd - 2) + 1);
  }

  // Index of a host in the NetworkStatus that this gateway publishes; 0: not there.
  static std::uint32_t status_index(const Context& context, std::uint64_t host) {
    const auto status = databuffer::read_valid(context.layout().network_status);
    for (std::uint32_t i = 1; status && i < status->host_count; ++i)
      if (host_id(text::text_of(status->hosts[i].name)) == host) return i;
    return 0;
  }

  // Another host of the run.
  struct Partner {
    std::array<std::optional<yars_net_LockstepSample>, databuffer::kLockstepRoles> waiting;  // newest of each role
    bool has_other_end = false;                                                              // which has been said
  };

  static bool has_arrived(const Context& context, const yars_net_LockstepSample& sample) {
    for (std::size_t i = 0; i < dds::kTopicCount; ++i) {
      const auto topic = static_cast<dds::Topic>(i);
      // The first four do not carry records, and lockstep has no samples but its own before this one.
      if (topic <= dds::Topic::clock_requests || topic == dds::Topic::lockstep || !context.reads(topic)) continue;
      if (context.hosts.numbers(topic, sample.host).next() < sample.written[i]) return false;
    }
    return true;
  }

  // Says once for each host that its run has another end.
  static void compare_end(const Context& context, Partner& partner, const yars_net_LockstepSample& sample) {
    const std::uint32_t own = end_word(context.layout().lockstep);
    const HostView* host = context.hosts.find(sample.host);
    const auto end_text = [](std::uint32_t end) {
      return end == kNoEnd ? "without end" : "to tick " + std::to_string(end - 1);
    };
    if (sample.end == own) partner.has_other_end = false;
    if (host == nullptr || sample.end == 0 || sample.end == own || std::exchange(partner.has_other_end, true)) return;
    context.hosts.say(log::warning, databuffer::NoteKind::refusal,
                      "lockstep " + end_text(sample.end) + " on host " + host->name + ", " + end_text(own) +
                          " here; give both the same --headless");
  }

  // Tells the roles of this host which role no longer answers: of several the one whose host has been gone longest.
  void watch_hosts(Context& context) {
    const std::int64_t elapsed_ns = std::min(context.now_ns - std::exchange(watched_ns_, context.now_ns), kMaxPass_ns);
    std::size_t lost = performers_.size();
    for (std::size_t role = 0; role < performers_.size(); ++role) {
      if (performers_[role] == 0) continue;
      const bool is_here = context.hosts.find(performers_[role]) != nullptr;
      gone_ns_[role] = is_here || has_ended(context, role) ? 0 : gone_ns_[role] + elapsed_ns;
      if (gone_ns_[role] > (lost < performers_.size() ? gone_ns_[lost] : kGone_ns)) lost = role;
    }
    std::uint32_t word = 0;
    if (lost < performers_.size())
      word = static_cast<std::uint32_t>(lost + 1) | status_index(context, performers_[lost]) << 8;
    context.session.layout().network.lost_role.store(word, std::memory_order_release);
  }

  // True if the role of another host has done its last tick, also if that is not applied yet.
  bool has_ended(const Context& context, std::size_t role) {
    const auto& lockstep = context.layout().lockstep;
    const std::int64_t end_tick = lockstep.end_tick.load(std::memory_order_relaxed);
    if (end_tick < 0) return false;
    const Partner* partner = partners_.find(performers_[role]);
    return lockstep.done_tick[role].load(std::memory_order_acquire) >= end_tick ||
           (partner != nullptr && partner->waiting[role] && partner->waiting[role]->done_tick >= end_tick);
  }

  // False: the tick waits.
  bool complete(Context& context, Partner& partner, const yars_net_LockstepSample& sample) {
    auto& lockstep = context.session.layout().lockstep;
    const std::size_t role = sample.role;
    // Also of a host that has left since: its last tick still counts.
    if (!context.hosts.has_announced(sample.host)) return false;
    compare_end(context, partner, sample);
    if (!has_arrived(context, sample)) return false;
    if (lockstep.done_tick[role].load(std::memory_order_acquire) >= sample.done_tick) return true;
    if (!others_are_done(lockstep, role, sample.done_tick)) return false;
    known_[role] = sample.done_tick;
    if (std::exchange(performers_[role], sample.host) != sample.host) gone_ns_[role] = 0;
    runtime::complete_tick(lockstep, role, sample.done_tick);
    return true;
  }

  // A role waits for its predecessor alone. That one's done tick may arrive here before those of roles on further hosts
  // whose records it has read: of the roles before it in this tick, and of those after it in the last tick.
  static bool others_are_done(const databuffer::Lockstep& lockstep, std::size_t role, std::int64_t tick) {
    const std::uint32_t roles = lockstep.roles.load(std::memory_order_relaxed);
    for (std::size_t other = 0; other < databuffer::kLockstepRoles; ++other) {
      const bool takes_part = other != role && (roles >> other & 1U) != 0;
      const std::int64_t needed = other < role ? tick : tick - 1;
      if (takes_part && lockstep.done_tick[other].load(std::memory_order_acquire) < needed) return false;
    }
    return true;
  }

  std::array<std::int64_t, databuffer::kLockstepRoles> done_{}, known_{};  // by local roles; sent or written here
  HostMemory<Partner> partners_;
  // Host that did the last tick of each role, 0: this one, or not known; [ns] time without it, while this process ran.
  std::array<std::uint64_t, databuffer::kLockstepRoles> performers_{};
  std::array<std::int64_t, databuffer::kLockstepRoles> gone_ns_{};
  std::int64_t watched_ns_ = 0;
};

}  // namespace yars::gateway
