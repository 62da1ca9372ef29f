// Topics of a session over DDS: their names, structures and quality of service.
// Inputs: the structures that idlc makes of gateway/yars_network.idl.
// Source: docs/network.md#topics, with the reason of each setting.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

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

constexpr Topic topic_of(const yars_net_HostSample*) {
  return Topic::hosts;
}
constexpr Topic topic_of(const yars_net_ProbeSample*) {
  return Topic::probes;
}
constexpr Topic topic_of(const yars_net_ClockSample*) {
  return Topic::clock;
}
constexpr Topic topic_of(const yars_net_ClockRequestSample*) {
  return Topic::clock_requests;
}
constexpr Topic topic_of(const yars_net_OwnshipSample*) {
  return Topic::ownship;
}
constexpr Topic topic_of(const yars_net_InputEventSample*) {
  return Topic::input_events;
}
constexpr Topic topic_of(const yars_net_EventReceiptSample*) {
  return Topic::event_receipts;
}
constexpr Topic topic_of(const yars_net_AppliedEventSample*) {
  return Topic::applied_events;
}
constexpr Topic topic_of(const yars_net_RadarStateSample*) {
  return Topic::radar_state;
}
constexpr Topic topic_of(const yars_net_OutputsSample*) {
  return Topic::outputs;
}
constexpr Topic topic_of(const yars_net_AdviceSample*) {
  return Topic::advice;
}
constexpr Topic topic_of(const yars_net_ModelStatusSample*) {
  return Topic::model_status;
}
constexpr Topic topic_of(const yars_net_ModelTickSample*) {
  return Topic::model_ticks;
}
constexpr Topic topic_of(const yars_net_SweepSample*) {
  return Topic::sweeps;
}
constexpr Topic topic_of(const yars_net_TrafficSample*) {
  return Topic::traffic;
}
constexpr Topic topic_of(const yars_net_LatchedTrafficSample*) {
  return Topic::traffic_latched;
}
constexpr Topic topic_of(const yars_net_PatchMapSample*) {
  return Topic::patch_maps;
}
constexpr Topic topic_of(const yars_net_PatchRowSample*) {
  return Topic::patch_rows;
}
constexpr Topic topic_of(const yars_net_CaptionSample*) {
  return Topic::captions;
}
constexpr Topic topic_of(const yars_net_RecorderStatusSample*) {
  return Topic::recorder_status;
}
constexpr Topic topic_of(const yars_net_LockstepSample*) {
  return Topic::lockstep;
}
constexpr Topic topic_of(const yars_net_WorldSample*) {
  return Topic::world;
}
constexpr Topic topic_of(const yars_net_LatchedWorldSample*) {
  return Topic::world_latched;
}
constexpr Topic topic_of(const yars_net_WorldRequestSample*) {
  return Topic::world_requests;
}

template <class Sample>
inline constexpr Topic kTopicOf = topic_of(static_cast<const Sample*>(nullptr));

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

const TopicSettings& settings_of(Topic topic);

}  // namespace yars::gateway::dds
