// Samples of a history (ring) that come from another host: each is taken once, also by a restarted gateway.
// Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gateway/exchange/context.hpp"
#include "gateway/exchange/progress.hpp"

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

// True if neither this gateway nor its predecessor has taken the sample. `local`: number of records in the local ring.
template <class Sample>
bool is_new_in_history(Context& context, const Sample& sample, std::uint64_t local) {
  constexpr dds::Topic kTopic = dds::kTopicOf<Sample>;
  if (!context.hosts.knows(kTopic, sample.host, sample.start)) {
    const std::uint64_t source = source_id({sample.host, sample.start});
    for (const databuffer::RemoteProgress& entry : context.session.layout().network.histories[history_of(kTopic)])
      if (entry.source.load() == source)
        context.hosts.resume(kTopic, sample.host, sample.start, next_of(entry.progress.load(), local, sample.number));
  }
  return context.hosts.is_new(sample);
}

// Call before the record is published in the local ring. `origin`: the sample, or what has its host, start and number.
template <class Sample, class Origin>
void keep_progress(Context& context, const Origin& origin, std::uint64_t local) {
  const std::uint64_t source = source_id({origin.host, origin.start});
  auto& entry = entry_of(context.session.layout().network.histories[history_of(dds::kTopicOf<Sample>)], source);
  if (entry.source.load() != source) entry.source.store(0);
  entry.progress.store(progress_of(origin.number + 1, local));
  entry.source.store(source);
}

}  // namespace yars::gateway
