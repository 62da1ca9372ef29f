// Topics in which the records of a role reach the other hosts. Who cannot write them does not have the role.
#pragma once

#include <array>
#include <span>

#include "databuffer/session/session_layout.hpp"
#include "gateway/dds/topics.hpp"

namespace yars::gateway {

struct RoleTopics {
  databuffer::Role role;
  std::span<const dds::Topic> topics;
};

inline constexpr std::array kTopicsOfModel{dds::Topic::model_status, dds::Topic::model_ticks, dds::Topic::sweeps};
inline constexpr std::array kTopicsOfMachine{dds::Topic::radar_state, dds::Topic::outputs, dds::Topic::applied_events,
                                             dds::Topic::event_receipts};
inline constexpr std::array kTopicsOfTraffic{dds::Topic::traffic};
inline constexpr std::array kTopicsOfRecorder{dds::Topic::recorder_status};
inline constexpr std::array kTopicsOfTour{dds::Topic::captions};
inline constexpr std::array<RoleTopics, 5> kRoleTopics{{{databuffer::Role::radar_model, kTopicsOfModel},
                                                        {databuffer::Role::state_machine, kTopicsOfMachine},
                                                        {databuffer::Role::traffic, kTopicsOfTraffic},
                                                        {databuffer::Role::recorder, kTopicsOfRecorder},
                                                        {databuffer::Role::tour, kTopicsOfTour}}};

}  // namespace yars::gateway
