// Well-formed samples of other hosts, for the fuzz target of the network.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/session/session.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/hosts.hpp"

namespace yars::fuzz {

using databuffer::Role;
using gateway::copy_record;
using gateway::host_id;

inline constexpr std::uint64_t kSegment = 2002, kOtherSegment = 3003;
inline constexpr std::uint64_t kStart =
    1001;  // of the gateway of this host; the first term of its state machine follows
inline constexpr std::array<const char*, 3> kHostNames{"beta", "gamma", "aaron"};

inline databuffer::Ownship good_ownship() {
  databuffer::Ownship own{};
  own.latitude_deg = 36.6;
  own.longitude_deg = -121.9;
  own.altitude_msl_m = 5000.0;
  own.radar_altitude_m = std::nan("");
  return own;
}

constexpr std::uint32_t bit(Role role) {
  return 1U << static_cast<unsigned>(role);
}

// Pixels of the patch maps, and video of the sweeps.
inline const std::vector<std::uint8_t>& bytes() {
  static const std::vector<std::uint8_t> all(radar::kMaxSamples, 7);
  return all;
}

// What makes an empty sample valid. One function for each structure that needs more than zeros.
template <class Sample>
void fill(Sample& /*sample*/, std::size_t /*host*/) {}
inline void fill(yars_net_HostSample& sample, std::size_t host) {
  std::strcpy(sample.name, kHostNames[host]);
  sample.segment = kOtherSegment;
  sample.layout_hash = databuffer::kLayoutIdentity.hash;
  sample.protocol = yars_net_kProtocol;
  sample.held_roles = host == 0 ? bit(Role::radar_model) | bit(Role::traffic) | bit(Role::recorder) | bit(Role::tour) |
                                      bit(Role::state_machine)
                                : 0;
  sample.owns_clock = host == 0 ? 1 : 0;
  sample.machine_term = host == 0 ? kOtherSegment : 0;
}
inline void fill(yars_net_ProbeSample& sample, std::size_t host) {
  sample.from = host_id("alpha");
  sample.to = host_id(kHostNames[host]);
  sample.stage = 1;
  sample.asked_ns = databuffer::monotonic_ns() - 200'000;
  sample.received_ns = sample.answered_ns = sample.asked_ns + 5'000'100'000;
}
inline databuffer::ClockState good_clock() {
  databuffer::ClockState clock{};
  clock.base_sim_ns = 60'000'000'000;
  clock.base_monotonic_ns = databuffer::monotonic_ns();
  clock.rate = 1.0;
  clock.running = 1;
  clock.reposition_latitude_deg = std::nan("");
  return clock;
}
inline void fill(yars_net_ClockSample& sample, std::size_t /*host*/) {
  copy_record(sample.clock, good_clock());
}
inline void fill(yars_net_ClockRequestSample& sample, std::size_t /*host*/) {
  copy_record(sample.clock, good_clock());
  copy_record(sample.before, good_clock());
  sample.owner = host_id("alpha");
}
inline void fill(yars_net_OwnshipSample& sample, std::size_t /*host*/) {
  copy_record(sample.ownship, good_ownship());
  sample.nav.mission_latitude_deg = std::nan("");
  sample.priority = 10;
}
inline databuffer::InputEvent good_event() {
  databuffer::InputEvent event{};
  event.kind = static_cast<std::uint16_t>(databuffer::EventKind::push_button);
  event.argument = 1;
  return event;
}
inline void fill(yars_net_InputEventSample& sample, std::size_t /*host*/) {
  copy_record(sample.event, good_event());
  sample.segment = kOtherSegment;
  sample.machine_term = kStart + 1;
  sample.event_number = sample.number;
}
inline void fill(yars_net_EventReceiptSample& sample, std::size_t /*host*/) {
  sample.sender = host_id("alpha");
  sample.segment = kSegment;
  sample.next_event = 1;
}
inline void fill(yars_net_AppliedEventSample& sample, std::size_t /*host*/) {
  copy_record(sample.applied.event, good_event());
  sample.sender = host_id("alpha");
}
inline void fill(yars_net_ModelStatusSample& sample, std::size_t /*host*/) {
  copy_record(sample.status.ownship, good_ownship());
}
inline void fill(yars_net_ModelTickSample& sample, std::size_t /*host*/) {
  copy_record(sample.tick.ownship, good_ownship());
  sample.tick.tick = 12'000;
  sample.tick.sim_time_ns = sample.tick.tick * radar::kTickNanoseconds;
}
inline void fill(yars_net_SweepSample& sample, std::size_t /*host*/) {
  sample.sweep.tick = 12'000;
  sample.sweep.sim_time_ns = sample.sweep.tick * radar::kTickNanoseconds;
  sample.sweep.azimuth_right_deg = 1.0;
  sample.sweep.range_m = 74'080.0;
  sample.sweep.scan = 1;
  sample.sweep.samples = 480;
  sample.video._length = 480;
}
inline void fill(yars_net_PatchMapSample& sample, std::size_t /*host*/) {
  databuffer::PatchMap map{};
  map.id = sample.id = 7;
  map.window_nm = 4.7;
  map.distance_m = 33'000.0;
  map.resolution_m = 20.0;
  map.size = 4;
  copy_record(sample.map, map);
}
inline void fill(yars_net_PatchRowSample& sample, std::size_t /*host*/) {
  sample.id = 7;
  sample.row = static_cast<std::uint32_t>(sample.number % 4);
  sample.length = 4;
  std::memset(sample.pixels, 7, sizeof sample.pixels);
}
inline void fill(yars_net_CaptionSample& sample, std::size_t /*host*/) {
  sample.caption.step = sample.caption.steps = 1;
}
inline databuffer::WorldState good_world(std::uint64_t edit) {
  databuffer::WorldState world{};
  world.edit = edit;
  world.source_time_ns = databuffer::monotonic_ns();
  return world;
}
inline void fill(yars_net_WorldSample& sample, std::size_t /*host*/) {
  copy_record(sample.newest, good_world(sample.number));
  copy_record(sample.configured, good_world(0));
  sample.has_configured = 1;
  sample.answers[0] = {host_id("alpha"), kSegment, 1, 1, 0};
}
inline void fill(yars_net_LatchedWorldSample& sample, std::size_t /*host*/) {
  copy_record(sample.world, good_world(sample.number));
  sample.segment = kOtherSegment;
  sample.ring_number = sample.number;
}
inline void fill(yars_net_WorldRequestSample& sample, std::size_t /*host*/) {
  copy_record(sample.world, good_world(1));
  sample.world.source_time_ns += 5'000'000'000;  // by the clock that the probes above tell
  sample.owner = host_id("alpha");
  sample.segment = kOtherSegment;
  sample.request = sample.number + 1;
}

// Makes the numbers right that a random change makes wrong.
template <class Sample>
void mend(Sample& /*sample*/) {}
inline void mend(yars_net_HostSample& sample) {
  sample.host = host_id(std::string_view(sample.name, strnlen(sample.name, sizeof sample.name)));
}
inline void mend(yars_net_SweepSample& sample) {
  sample.video._length = std::min<std::uint32_t>(sample.sweep.samples, radar::kMaxSamples);
  databuffer::Sweep sweep{};
  std::memcpy(&sweep, &sample.sweep, sizeof sample.sweep);
  std::memcpy(sweep.video, bytes().data(), sample.video._length);
  sweep.samples = sample.video._length;
  sample.sweep.hash = databuffer::sweep_hash(sweep);
}
inline void mend(yars_net_PatchMapSample& sample) {
  databuffer::PatchMap map{};
  copy_record(map, sample.map);
  map.id = sample.id;
  const std::size_t pixels = std::size_t{std::min<std::uint32_t>(map.size, 32)} * std::min<std::uint32_t>(map.size, 32);
  map.hash = databuffer::map_hash(map, std::span(bytes()).first(pixels));
  copy_record(sample.map, map);
}

}  // namespace yars::fuzz
