// Samples of a history (ring) that come from another host: each is taken once, also by a restarted gateway.
// Threads: one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "gateway/exchange/context.hpp"
#include "gateway/exchange/progress.hpp"
#include "lib/radar/modes.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::gateway {

// Index of a history in databuffer::Network::histories.
constexpr std::size_t history_of(dds::Topic topic) {
  switch (topic) {
    case dds::Topic::applied_events:
      return 0;
    case dds::Topic::traffic_latched:
      return 1;
    case dds::Topic::model_ticks:
      return 2;
    default:
      return 3;  // sweeps
  }
}

// [ns] sim time. A host that hears a history for the first time begins with records of this age. Without a limit its
// recorder would take the last 5 s of the session for new.
inline constexpr std::int64_t kMaxFirstAge_ns = 500'000'000;

// True if neither this gateway nor its predecessor has taken the sample, and it is not from before the host joined.
// `local`: number of records in the local ring. `tick`: of the record.
template <class Sample>
bool is_new_in_history(Context& context, const Sample& sample, std::uint64_t local, std::int64_t tick) {
  constexpr dds::Topic kTopic = dds::kTopicOf<Sample>;
  if (!context.hosts.knows(kTopic, sample.host, sample.start)) {
    const std::uint64_t source = source_id({sample.host, sample.start});
    const auto& entries = context.session.layout().network.histories[history_of(kTopic)];
    const auto entry = std::ranges::find_if(entries, [source](const auto& one) { return one.source.load() == source; });
    if (entry != entries.end())
      context.hosts.resume(kTopic, sample.host, sample.start, next_of(entry->progress.load(), local, sample.number));
    else if (!context.lockstep && tick < (context.session.sim_time_ns() - kMaxFirstAge_ns) / radar::kTickNanoseconds)
      return false;
  }
  return context.hosts.is_new(sample);
}

// True once the records of a history of another host may be taken. `newest()`: tick of the state that the host last
// published; nullopt: none has arrived. It is called only until the history has begun. A lockstep run, whose ticks do
// not follow the session clock, is not known here until a role of this host begins it. Its first records would be taken
// for old ones, and nobody would send them again.
template <class Newest>
bool may_begin(const Context& context, dds::Topic topic, std::uint64_t host, const Newest& newest) {
  if (context.lockstep || host == context.hosts.self().id ||
      context.hosts.knows(topic, host, context.hosts.segment_of(host)))
    return true;
  const double max_age_ns = 0.5 * static_cast<double>(kMaxFirstAge_ns) * std::max(1.0, context.session.clock().rate);
  const std::int64_t oldest_ns = context.session.sim_time_ns() - static_cast<std::int64_t>(max_age_ns);
  const std::optional<std::int64_t> tick = newest();
  return tick && *tick >= oldest_ns / radar::kTickNanoseconds;
}

// Order of the ticks that one topic brings. Within an epoch the ticks of a host count up. A new process of a role may
// begin up to kMaxTicksBehind ticks before the last one of its predecessor.
class TickOrder {
 public:
  // False: the tick is from before the last one of its host. After kConfirmations such ticks, each later than the one
  // before, the last one is taken for the error. Else one forged tick of the far future would stop the history.
  bool follows(std::uint64_t host, std::uint32_t epoch, std::int64_t tick) {
    const bool is_known = host == host_ && epoch == epoch_;
    const bool goes_back = is_known && tick < tick_ - runtime::kMaxTicksBehind;
    if (goes_back) {
      run_ = run_ > 0 && tick > run_tick_ ? run_ + 1 : 1;
      run_tick_ = tick;
      if (run_ < kConfirmations) return false;
    }
    run_ = 0;
    tick_ = is_known && !goes_back ? std::max(tick_, tick) : tick;
    host_ = host;
    epoch_ = epoch;
    return true;
  }

 private:
  static constexpr int kConfirmations = 20;  // 0.1 s of ticks
  std::uint64_t host_ = 0;
  std::uint32_t epoch_ = 0;
  std::int64_t tick_ = 0, run_tick_ = 0;
  int run_ = 0;
};

// True once it is known which host has the radar model and, if that is another one, this gateway mirrors it. Samples of
// a history wait in DDS until then.
inline bool knows_model(const Context& context) {
  const auto holder = context.roles.holder(databuffer::Role::radar_model);
  return holder &&
         (*holder == context.hosts.self().id || context.roles.source(databuffer::Role::radar_model).has_value());
}

// True in the last tick of a lockstep run. A role whose process has ended by then has been heard by all roles.
inline bool is_last_tick(const Context& context) {
  const auto& lockstep = std::as_const(context.session).layout().lockstep;
  const std::int64_t end_tick = lockstep.end_tick.load(std::memory_order_relaxed);
  return context.lockstep && end_tick >= 0 &&
         std::ranges::any_of(lockstep.done_tick, [end_tick](const auto& tick) { return tick.load() >= end_tick; });
}

// Where a gateway begins that finds a local process writing the ring: its predecessor may have missed the last `recent`
// records. Records of other hosts are left out.
template <class Ring>
std::uint64_t first_to_send(Context& context, dds::Topic topic, const Ring& ring, std::uint64_t recent) {
  const std::uint64_t next = ring.next();
  const std::uint64_t own = std::min(next, context.session.layout().network.last_remote[history_of(topic)].load());
  return std::max({ring.oldest(), next - std::min(next, recent), own});
}

// Call before the record is published in the local ring. `origin`: the sample, or what has its host, start and number.
template <class Sample, class Origin>
void keep_progress(Context& context, const Origin& origin, std::uint64_t local) {
  const std::uint64_t source = source_id({origin.host, origin.start});
  auto& entry = entry_of(context.session.layout().network.histories[history_of(dds::kTopicOf<Sample>)], source);
  if (entry.source.load() != source) entry.source.store(0);
  entry.progress.store(progress_of(origin.number + 1, local));
  entry.source.store(source);
  context.session.layout().network.last_remote[history_of(dds::kTopicOf<Sample>)].store(local + 1);
}

}  // namespace yars::gateway
