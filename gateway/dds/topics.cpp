#include "gateway/dds/topics.hpp"

#include "databuffer/messages/network_status.hpp"

namespace yars::gateway::dds {

namespace {

// Instances of one writer by the keys of a topic, with room for some that have ended elsewhere.
constexpr std::uint32_t kOne = 2;         // its host
constexpr std::uint32_t kPairs = 64;      // its host and another one, a lane or a role
constexpr std::uint32_t kReceipts = 512;  // another host and a lane
constexpr std::uint32_t kMaps = 64;       // eight
constexpr std::uint32_t kRows = 16384;    // 1024 rows of each of eight maps, and of eight before them
constexpr std::uint32_t kAllRows = 65536;

constexpr TopicSettings topic(std::string_view name, const dds_topic_descriptor_t* structure, bool reliable,
                              bool transient_local, int depth, bool exclusive, std::uint32_t instances) {
  const std::uint32_t all = instances == kRows ? kAllRows : instances * databuffer::kMaxHosts;
  return {name, structure, reliable, transient_local, depth, exclusive, instances, all};
}

// name, structure, reliable, transient-local, depth, exclusive, instances. Histories have the depth of their rings.
constexpr std::array<TopicSettings, kTopicCount> kSettings{{
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

}  // namespace

const TopicSettings& settings_of(Topic topic) {
  return kSettings[index_of(topic)];
}

}  // namespace yars::gateway::dds
