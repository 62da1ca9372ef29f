#include "gateway/dds/topics.hpp"

namespace yars::gateway::dds {

namespace {

// name, structure, reliable, transient-local, depth, exclusive. Histories have the depth of their rings.
constexpr std::array<TopicSettings, kTopicCount> kSettings{{
    {"hosts", &yars_net_HostSample_desc, true, true, 1, false},
    {"probes", &yars_net_ProbeSample_desc, false, false, 1, false},
    {"clock", &yars_net_ClockSample_desc, true, true, 1, false},
    {"clock_requests", &yars_net_ClockRequestSample_desc, true, true, 16, false},
    {"ownship", &yars_net_OwnshipSample_desc, true, false, 1, true},
    {"input_events", &yars_net_InputEventSample_desc, true, true, 128, false},
    {"event_receipts", &yars_net_EventReceiptSample_desc, true, true, 1, false},
    {"applied_events", &yars_net_AppliedEventSample_desc, true, true, 1024, false},
    {"radar_state", &yars_net_RadarStateSample_desc, true, true, 1, false},
    {"outputs", &yars_net_OutputsSample_desc, true, true, 1, false},
    {"advice", &yars_net_AdviceSample_desc, true, true, 1, false},
    {"model_status", &yars_net_ModelStatusSample_desc, true, true, 1, false},
    {"model_ticks", &yars_net_ModelTickSample_desc, true, true, 1024, false},
    {"sweeps", &yars_net_SweepSample_desc, true, true, 1024, false},
    {"traffic", &yars_net_TrafficSample_desc, true, true, 1, false},
    {"traffic_latched", &yars_net_LatchedTrafficSample_desc, true, true, 64, false},
    {"patch_maps", &yars_net_PatchMapSample_desc, true, true, 1, false},
    {"patch_rows", &yars_net_PatchRowSample_desc, true, true, 1, false},
    {"captions", &yars_net_CaptionSample_desc, true, true, 1, false},
    {"recorder_status", &yars_net_RecorderStatusSample_desc, true, true, 1, false},
    {"lockstep", &yars_net_LockstepSample_desc, true, true, 1, false},
}};

}  // namespace

const TopicSettings& settings_of(Topic topic) {
  return kSettings[index_of(topic)];
}

}  // namespace yars::gateway::dds
