// Topics of a session over DDS: their names, structures and quality of service.
// Inputs: the structures that idlc makes of gateway/yars_network.idl.
// Source: docs/network.md#topics, with the reason of each setting.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "databuffer/messages/network_status.hpp"
#include "gateway/dds/yars_network.h"

namespace yars::gateway::dds {

// In the order of gateway/yars_network.idl. LockstepSample::written has the same order.
enum class Topic : std::uint8_t {
  hosts,
  probes,
  clock,
  clock_requests,
  ownship,
  input_events,
  event_receipts,
  applied_events,
  radar_state,
  outputs,
  advice,
  model_status,
  model_ticks,
  sweeps,
  traffic,
  traffic_latched,
  patch_maps,
  patch_rows,
  captions,
  recorder_status,
  lockstep,
  world,
  world_latched,
  world_requests
};
inline constexpr std::size_t kTopicCount = 24;
static_assert(kTopicCount == yars_net_kTopics);

constexpr std::size_t index_of(Topic topic) {
  return static_cast<std::size_t>(topic);
}

// Structures of the topics, in the same order.
using Samples =
    std::tuple<yars_net_HostSample, yars_net_ProbeSample, yars_net_ClockSample, yars_net_ClockRequestSample,
               yars_net_OwnshipSample, yars_net_InputEventSample, yars_net_EventReceiptSample,
               yars_net_AppliedEventSample, yars_net_RadarStateSample, yars_net_OutputsSample, yars_net_AdviceSample,
               yars_net_ModelStatusSample, yars_net_ModelTickSample, yars_net_SweepSample, yars_net_TrafficSample,
               yars_net_LatchedTrafficSample, yars_net_PatchMapSample, yars_net_PatchRowSample, yars_net_CaptionSample,
               yars_net_RecorderStatusSample, yars_net_LockstepSample, yars_net_WorldSample,
               yars_net_LatchedWorldSample, yars_net_WorldRequestSample>;

template <class Sample, class... All>
constexpr std::ptrdiff_t position_in(const std::tuple<All...>*) {
  constexpr std::array is_same{std::is_same_v<Sample, All>...};
  static_assert(is_same.size() == kTopicCount);
  return std::ranges::find(is_same, true) - is_same.begin();
}
template <class Sample>
inline constexpr Topic kTopicOf = static_cast<Topic>(position_in<Sample>(static_cast<const Samples*>(nullptr)));

// What a topic asks of DDS. KEEP_LAST everywhere: with KEEP_ALL a lost host would block the writer. No liveliness
// leases: Cyclone DDS 0.10.2 ends with a segmentation fault when many of them expire (docs/decisions/0033).
struct TopicSettings {
  std::string_view name;
  const dds_topic_descriptor_t* structure;
  bool reliable;
  bool transient_local;  // a host that joins later gets the last `depth` samples of each instance
  int depth;
  bool exclusive;               // only the samples of the writer with the greatest strength arrive
  std::uint32_t instances;      // maximum number of instances (keys) of one writer
  std::uint32_t all_instances;  // of all writers
};

// Instances of one writer by the keys of a topic, with room for some that have ended elsewhere.
inline constexpr std::uint32_t kOne = 2;         // its host
inline constexpr std::uint32_t kPairs = 64;      // its host and another one, a lane or a role
inline constexpr std::uint32_t kReceipts = 512;  // another host and a lane
inline constexpr std::uint32_t kMaps = 64;       // eight
inline constexpr std::uint32_t kRows = 16384;    // 1024 rows of each of eight maps, and of eight before them
inline constexpr std::uint32_t kAllRows = 65536;

constexpr TopicSettings topic(std::string_view name, const dds_topic_descriptor_t* structure, bool reliable,
                              bool transient_local, int depth, bool exclusive, std::uint32_t instances) {
  const std::uint32_t all = instances == kRows ? kAllRows : instances * databuffer::kMaxHosts;
  return {name, structure, reliable, transient_local, depth, exclusive, instances, all};
}

// name, structure, reliable, transient-local, depth, exclusive, instances. Histories have the depth of their rings.
inline constexpr std::array<TopicSettings, kTopicCount> kSettings{{
    topic("hosts", &yars_net_HostSample_desc, true, true, 1, false, kOne),
    topic("probes", &yars_net_ProbeSample_desc, false, false, 1, false, kPairs),
    topic("clock", &yars_net_ClockSample_desc, true, true, 1, false, kOne),
    topic("clock_requests", &yars_net_ClockRequestSample_desc, true, true, 16, false, kOne),
    topic("ownship", &yars_net_OwnshipSample_desc, true, false, 1, true, kOne),
    topic("input_events", &yars_net_InputEventSample_desc, true, true, 128, false, kPairs),
    topic("event_receipts", &yars_net_EventReceiptSample_desc, true, true, 1, false, kReceipts),
    topic("applied_events", &yars_net_AppliedEventSample_desc, true, true, 1024, false, kOne),
    topic("radar_state", &yars_net_RadarStateSample_desc, true, true, 1, false, kOne),
    topic("outputs", &yars_net_OutputsSample_desc, true, true, 1, false, kOne),
    topic("advice", &yars_net_AdviceSample_desc, true, true, 1, false, kOne),
    topic("model_status", &yars_net_ModelStatusSample_desc, true, true, 1, false, kOne),
    topic("model_ticks", &yars_net_ModelTickSample_desc, true, true, 1024, false, kOne),
    topic("sweeps", &yars_net_SweepSample_desc, true, true, 1024, false, kOne),
    topic("traffic", &yars_net_TrafficSample_desc, true, true, 1, false, kOne),
    topic("traffic_latched", &yars_net_LatchedTrafficSample_desc, true, true, 64, false, kOne),
    topic("patch_maps", &yars_net_PatchMapSample_desc, true, true, 1, false, kMaps),
    topic("patch_rows", &yars_net_PatchRowSample_desc, true, true, 1, false, kRows),
    topic("captions", &yars_net_CaptionSample_desc, true, true, 1, false, kOne),
    topic("recorder_status", &yars_net_RecorderStatusSample_desc, true, true, 1, false, kOne),
    topic("lockstep", &yars_net_LockstepSample_desc, true, true, 1, false, kPairs),
    topic("world", &yars_net_WorldSample_desc, true, true, 1, false, kOne),
    topic("world_latched", &yars_net_LatchedWorldSample_desc, true, true, 16, false, kOne),
    topic("world_requests", &yars_net_WorldRequestSample_desc, true, true, 1, false, kOne),
}};

constexpr const TopicSettings& settings_of(Topic topic) {
  return kSettings[index_of(topic)];
}

}  // namespace yars::gateway::dds
