// Topics of a session over DDS: their names, structures and quality of service.
// Inputs: the structures that idlc makes of gateway/yars_network.idl.
// Source: docs/network.md#topics, with the reason of each setting.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "gateway/dds/yars_network.h"
#include "lib/radar/network.hpp"

namespace yars::gateway::dds {

// Instances of one writer by the keys of a topic, with room for some that have ended elsewhere.
inline constexpr std::uint32_t kOne = 2;         // its host
inline constexpr std::uint32_t kPairs = 64;      // its host and another one, a lane or a role
inline constexpr std::uint32_t kReceipts = 512;  // another host and a lane
inline constexpr std::uint32_t kMaps = 64;       // eight
inline constexpr std::uint32_t kRows = 16384;    // 1024 rows of each of eight maps, and of eight before them

// TOPIC(name, structure, samples kept of each instance, instances of one writer), in the order of
// gateway/yars_network.idl. LockstepSample::written has the same order. Histories have the depth of their rings.
#define YARS_TOPICS(TOPIC)                                         \
  TOPIC(hosts, yars_net_HostSample, 1, kOne)                       \
  TOPIC(probes, yars_net_ProbeSample, 1, kPairs)                   \
  TOPIC(clock, yars_net_ClockSample, 1, kOne)                      \
  TOPIC(clock_requests, yars_net_ClockRequestSample, 16, kOne)     \
  TOPIC(ownship, yars_net_OwnshipSample, 1, kOne)                  \
  TOPIC(input_events, yars_net_InputEventSample, 128, kPairs)      \
  TOPIC(event_receipts, yars_net_EventReceiptSample, 1, kReceipts) \
  TOPIC(applied_events, yars_net_AppliedEventSample, 1024, kOne)   \
  TOPIC(radar_state, yars_net_RadarStateSample, 1, kOne)           \
  TOPIC(outputs, yars_net_OutputsSample, 1, kOne)                  \
  TOPIC(advice, yars_net_AdviceSample, 1, kOne)                    \
  TOPIC(model_status, yars_net_ModelStatusSample, 1, kOne)         \
  TOPIC(model_ticks, yars_net_ModelTickSample, 1024, kOne)         \
  TOPIC(sweeps, yars_net_SweepSample, 1024, kOne)                  \
  TOPIC(traffic, yars_net_TrafficSample, 1, kOne)                  \
  TOPIC(traffic_latched, yars_net_LatchedTrafficSample, 64, kOne)  \
  TOPIC(patch_maps, yars_net_PatchMapSample, 1, kMaps)             \
  TOPIC(patch_rows, yars_net_PatchRowSample, 1, kRows)             \
  TOPIC(captions, yars_net_CaptionSample, 1, kOne)                 \
  TOPIC(recorder_status, yars_net_RecorderStatusSample, 1, kOne)   \
  TOPIC(lockstep, yars_net_LockstepSample, 1, kPairs)              \
  TOPIC(world, yars_net_WorldSample, 1, kOne)                      \
  TOPIC(world_latched, yars_net_LatchedWorldSample, 16, kOne)      \
  TOPIC(world_requests, yars_net_WorldRequestSample, 1, kOne)

#define YARS_TOPIC(name, ...) name,
enum class Topic : std::uint8_t { YARS_TOPICS(YARS_TOPIC) };
#undef YARS_TOPIC

#define YARS_TOPIC(name, Sample, ...)       \
  constexpr Topic topic_of(const Sample*) { \
    return Topic::name;                     \
  }
YARS_TOPICS(YARS_TOPIC)
#undef YARS_TOPIC
template <class Sample>
inline constexpr Topic kTopicOf = topic_of(static_cast<const Sample*>(nullptr));

constexpr std::size_t index_of(Topic topic) {
  return static_cast<std::size_t>(topic);
}

struct TopicSettings {
  std::string_view name;
  const dds_topic_descriptor_t* structure;
  int depth;                // samples kept of each instance
  std::uint32_t instances;  // maximum number of instances (keys) of one writer
};

inline constexpr std::size_t kTopicCount = yars_net_kTopics;
#define YARS_TOPIC(name, Sample, depth, instances) TopicSettings{#name, &Sample##_desc, depth, instances},
inline constexpr std::array<TopicSettings, kTopicCount> kSettings{{YARS_TOPICS(YARS_TOPIC)}};
#undef YARS_TOPIC
static_assert(std::ranges::equal(kSettings, radar::kTopicNames, {}, &TopicSettings::name));

constexpr const TopicSettings& settings_of(Topic topic) {
  return kSettings[index_of(topic)];
}

}  // namespace yars::gateway::dds
