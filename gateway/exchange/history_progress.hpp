// Histories (rings) of a host on every host: each record is taken once, also by a restarted gateway. The progress of
// records from other hosts is kept in the segment for the next gateway (databuffer RemoteProgress).
// Inputs: number of a record at its source; number of records in the local container before it is written.
// Errors: numbers are kept with 32 and 27 bits. A source that is 2^31 records ahead of its entry is taken for another
// place; so is a container to which others have added a multiple of 2^27 records.
// A gateway killed at any point leaves an entry from which the next one continues without gap or repetition.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <string_view>

#include "databuffer/session/session_layout.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/host_agreement.hpp"
#include "lib/radar/modes.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::gateway {

// Name of a container of another host: FNV-1a over the bytes of the numbers; not 0.
inline std::uint64_t source_id(std::initializer_list<std::uint64_t> numbers) {
  const std::string_view bytes(reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(std::uint64_t));
  return std::max<std::uint64_t>(host_id(bytes), 1);
}

inline constexpr std::uint64_t kLocalMask = 0x07FF'FFFFU;

// Entry before record number `next - 1` is written as record `local` of lane `lane` here (0 for a ring).
inline std::uint64_t progress_of(std::uint64_t next, std::uint64_t local, std::size_t lane = 0) {
  return next << 32 | std::uint64_t{lane & 0x1FU} << 27 | (local & kLocalMask);
}
inline std::size_t lane_of(std::uint64_t progress) {
  return progress >> 27 & 0x1FU;
}

// True if a container with `local` records ends with the last record of an entry, or still lacks it.
inline bool ends_with(std::uint64_t progress, std::uint64_t local) {
  return ((local - progress) & kLocalMask) <= 1;
}

// Number of the next record to take, according to an entry. `local`: number of records in the container now. `near`: a
// number less than 2^31 away from the result.
inline std::uint64_t next_of(std::uint64_t progress, std::uint64_t local, std::uint64_t near) {
  const auto difference = static_cast<std::int32_t>(static_cast<std::uint32_t>((progress >> 32) - near));
  const std::uint64_t next = near + static_cast<std::uint64_t>(std::int64_t{difference});
  const bool is_missing = ((local - progress) & kLocalMask) == 0;
  return is_missing ? next - 1 : next;
}

// Entry of a source in a table; nullptr: it has none.
template <class Entries>
auto find_entry(Entries& entries, std::uint64_t source) {
  const auto found =
      std::ranges::find_if(entries, [source](const auto& entry) { return entry.source.load() == source; });
  return found == entries.end() ? nullptr : &*found;
}

// The entry to write: that of the source, else a free one, else one of a source that is not known, else the one at
// `source % size`.
template <class Entries>
databuffer::RemoteProgress& entry_of(
    Entries& entries, std::uint64_t source,
    const std::function<bool(std::uint64_t)>& is_known = [](auto) { return true; }) {
  for (const std::uint64_t wanted : {source, std::uint64_t{0}})
    if (auto* entry = find_entry(entries, wanted)) return *entry;
  const auto unknown =
      std::ranges::find_if(entries, [&is_known](const auto& entry) { return !is_known(entry.source.load()); });
  return unknown != entries.end() ? *unknown : entries[source % entries.size()];
}

// Writes an entry. Call it before the record is written in the local container.
inline void store_progress(databuffer::RemoteProgress& entry, std::uint64_t source, std::uint64_t progress) {
  if (entry.source.load() != source) entry.source.store(0);
  entry.progress.store(progress);
  entry.source.store(source);
}

// In the order of databuffer::Network::histories.
inline constexpr std::array kHistories{dds::Topic::applied_events, dds::Topic::traffic_latched, dds::Topic::model_ticks,
                                       dds::Topic::sweeps};

// [ns] sim time. A host that hears a history for the first time takes no older records, which its recorder had not had.
inline constexpr std::int64_t kMaxFirstAge_ns = 500'000'000;

// True once the records of a history of another host may be taken. `newest()`: tick of the state that the host last
// published, if any; it is called only until the history has begun. A lockstep run is not known here until a role of
// this host begins it. Its first records, which nobody sends again, would be taken for old ones.
template <class Newest>
bool may_begin(const Context& context, dds::Topic topic, std::uint64_t host, const Newest& newest) {
  if (context.lockstep || host == context.hosts.self().id ||
      context.hosts.numbers(topic, host).knows(context.hosts.said_by(host).segment))
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
  const auto holder = context.roles.holder(Role::radar_model);
  return holder && (*holder == context.hosts.self().id || context.roles.source(Role::radar_model).has_value());
}

// True in the last tick of a lockstep run. A role whose process has ended by then has been heard by all roles.
inline bool is_last_tick(const Context& context) {
  const auto& lockstep = context.layout().lockstep;
  const std::int64_t end_tick = lockstep.end_tick.load(std::memory_order_relaxed);
  return context.lockstep && end_tick >= 0 &&
         std::ranges::any_of(lockstep.done_tick, [end_tick](const auto& tick) { return tick.load() >= end_tick; });
}

// One history on its way between hosts: a ring of the segment, whose records the holder of a role writes, and a topic.
template <class Sample, class Record, auto kRing, Role kRole>
class History {
 public:
  // `recent`: a gateway that finds a local process writing the ring sends the last records again, because its
  // predecessor may have missed them.
  explicit History(std::uint64_t recent) : recent_(recent) {}

  // Sends what the local ring has got since the last call, unless it is of another host. fill(sample, record) writes
  // what follows host, start and number.
  template <class Fill>
  void send(Context& context, const Fill& fill) {
    const auto& layout = context.layout();
    const auto& ring = layout.*kRing;
    const std::uint64_t next = ring.next();
    if (!context.roles.exports(kRole)) {
      cursor_ = next;
      return;
    }
    const std::uint64_t own = std::min(next, layout.network.last_remote[kIndex].load());
    if (!cursor_) cursor_ = std::max({ring.oldest(), next - std::min(next, recent_), own});
    Sample sample{};
    Record record{};
    while (ring.read(*cursor_, record).delivered) {
      sample.host = context.hosts.self().id;
      sample.start = context.segment();
      sample.number = *cursor_ - 1;
      fill(sample, record);
      context.write(sample);
    }
    context.hosts.set_written(kTopic, *cursor_);
  }

  // True if the sample is of the host with the role, neither this gateway nor its predecessor has taken it, and it is
  // not from before this host joined. `tick`: of the record. A sample of another host counts as taken.
  bool is_wanted(Context& context, const Sample& sample, std::int64_t tick) const {
    const std::uint64_t source = source_id({sample.host, sample.start});
    const auto& layout = context.layout();
    if (!context.hosts.numbers(kTopic, sample.host).knows(sample.start)) {
      if (const auto* entry = find_entry(layout.network.histories[kIndex], source))
        context.hosts.resume(kTopic, sample.host, sample.start,
                             next_of(entry->progress.load(), (layout.*kRing).next(), sample.number));
      else if (!context.lockstep && tick < (context.session.sim_time_ns() - kMaxFirstAge_ns) / radar::kTickNanoseconds)
        return false;
    }
    return context.hosts.is_new(sample) && context.roles.source(kRole) == sample.host;
  }

  // Publishes a record of another host. `origin` has its sample's host, start and number. Output: its number here.
  template <class Origin>
  std::uint64_t publish(Context& context, const Origin& origin, const Record& record) const {
    auto& layout = context.session.layout();
    auto& ring = layout.*kRing;
    const std::uint64_t source = source_id({origin.host, origin.start});
    store_progress(entry_of(layout.network.histories[kIndex], source), source,
                   progress_of(origin.number + 1, ring.next()));
    layout.network.last_remote[kIndex].store(ring.next() + 1);
    return ring.publish(record);
  }

 private:
  static constexpr dds::Topic kTopic = dds::kTopicOf<Sample>;
  static constexpr std::size_t kIndex =
      static_cast<std::size_t>(std::ranges::find(kHistories, kTopic) - kHistories.begin());
  static_assert(kIndex < kHistories.size());

  std::uint64_t recent_;
  std::optional<std::uint64_t> cursor_;  // next record of the local ring to send; nullopt: none was sent
};

// Numbers of the records of a history: in the ring of the host that has the role, and in the ring here.
template <std::size_t kMax>
class RecordNumbers {
 public:
  // True if the last record of the ring here is one that came from that segment. `next`: number of records in the ring.
  bool continues(std::uint64_t host, std::uint64_t segment, std::uint64_t next) const {
    return host == host_ && segment == segment_ && !pairs_.empty() && pairs_.back().ours + 1 == next;
  }
  // True if, in addition, that segment's record `number` has been written here.
  bool has(std::uint64_t host, std::uint64_t segment, std::uint64_t number, std::uint64_t next) const {
    return continues(host, segment, next) && number <= pairs_.back().theirs;
  }
  // `ours`: number of the record in the ring here.
  void add(std::uint64_t host, std::uint64_t segment, std::uint64_t number, std::uint64_t ours) {
    if (host != host_ || segment != segment_) pairs_.clear();
    host_ = host;
    segment_ = segment;
    pairs_.push_back({number, ours});
    if (pairs_.size() > kMax) pairs_.pop_front();
  }
  // Number of records in the ring here up to the one that the other host's count names; nullopt: it has not arrived.
  std::optional<std::uint64_t> local(std::uint64_t host, std::uint64_t count) const {
    if (count == 0) return 0;
    if (host != host_) return std::nullopt;
    for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair)
      if (pair->theirs + 1 == count) return pair->ours + 1;
    return std::nullopt;
  }

 private:
  struct Pair {
    std::uint64_t theirs, ours;
  };
  std::uint64_t host_ = 0, segment_ = 0;
  std::deque<Pair> pairs_;
};
using WorldNumbers = RecordNumbers<databuffer::kLatchedWorlds>;

}  // namespace yars::gateway
