#include "tests/fuzz/overlaid_session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/schema/load.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/error/error.hpp"
#include "statemachine/machine.hpp"
#include "world/world_values.hpp"

namespace yars::fuzz {

namespace {

using namespace databuffer;

constexpr std::size_t kLarge_bytes = 512;
constexpr std::uint64_t kMaxPublished = 64;  // [records] that the programs under test publish into a ring in one run

Ownship good_ownship() {
  Ownship own{};
  own.latitude_deg = 36.6;
  own.longitude_deg = -121.9;
  own.altitude_msl_m = 5000.0;
  own.velocity_north_mps = 200.0;
  own.radar_altitude_m = std::nan("");
  std::strcpy(own.source, "fixed");
  return own;
}

Nav good_nav() {
  Nav nav{};
  nav.mission_latitude_deg = nav.ins_latitude_deg = 36.6;
  nav.mission_longitude_deg = nav.ins_longitude_deg = -121.9;
  nav.velocity_north_mps = 200.0;
  return nav;
}

PatchMap good_map() {
  PatchMap map{};
  map.id = 7;
  map.latitude_deg = 36.9;
  map.longitude_deg = -121.9;
  map.apex_latitude_deg = 36.6;
  map.apex_longitude_deg = -121.9;
  map.apex_altitude_msl_m = 5000.0;
  map.window_nm = 4.7;
  map.distance_m = 33'000.0;
  map.resolution_m = 20.0;
  map.size = 64;
  return map;
}

Sweep good_sweep() {
  Sweep sweep{};
  sweep.apex_latitude_deg = 36.6;
  sweep.apex_longitude_deg = -121.9;
  sweep.apex_altitude_msl_m = 5000.0;
  sweep.azimuth_left_deg = 10.0;
  sweep.azimuth_right_deg = 10.5;
  sweep.range_m = 74'080.0;
  sweep.scan = 1;
  sweep.samples = 512;
  std::fill(std::begin(sweep.video), std::end(sweep.video), std::uint8_t{100});
  return sweep;
}

// A world with one entry of each list.
WorldState good_world() {
  radar::WorldConfiguration world;
  world.rain.cells = {{.position = {36.5, -122.0}}};
  world.jamming.jammers = {{.name = "jammer", .position = {36.5, -122.0}}};
  world.movers = {{.name = "ship", .position = {36.5, -122.0}}};
  WorldState state = world::world_state_from(world);
  state.flags = {};
  state.edit = 1;
  return state;
}

// Overwrites bytes of the record from `offset` on.
template <class T>
void lay(T& record, std::size_t offset, std::span<const std::uint8_t> bytes) {
  offset %= sizeof record;
  std::memcpy(reinterpret_cast<char*>(&record) + offset, bytes.data(), std::min(bytes.size(), sizeof record - offset));
}

}  // namespace

OverlaidSession::OverlaidSession(const std::string& name)
    : name_(name), session_(*Session::open(name, "fuzz")), parts_(parts()), sound_(well_formed()), records_(sound_) {
  ClockState clock = sound_.clock;
  layout().clock.publish(clock);
  before_.resize(sizeof(SessionLayout));
  std::memcpy(before_.data(), memory(), before_.size());
}

OverlaidSession::Records OverlaidSession::well_formed() {
  Records records{};
  records.clock.base_sim_ns = 60'000'000'000;
  records.clock.rate = 1.0;
  records.clock.reposition_latitude_deg = std::nan("");
  records.ownship.fill(good_ownship());
  records.nav.fill(good_nav());
  const auto configuration = config::load_configuration_text("", "built-in")->radar;
  records.state = statemachine::initial_state(configuration);
  records.state.power = static_cast<std::uint8_t>(radar::Power::operate);
  records.state.map_newest = records.state.map_shown = 7;
  records.status.ownship = good_ownship();
  records.status.nav = good_nav();
  records.status.map_newest = 7;
  records.tick.ownship = good_ownship();
  records.event.kind = static_cast<std::uint16_t>(EventKind::push_button);
  records.event.argument = 1;
  records.event.monotonic_ns = monotonic_ns();
  records.applied.event = records.event;
  records.sweep = good_sweep();
  records.traffic.count = 2;
  records.world = good_world();
  records.map = good_map();
  records.frame.id = 3;
  records.frame.width = records.frame.height = 32;
  std::strcpy(records.note.process, "radar-model");
  std::strcpy(records.note.text, "resumes");
  records.caption.step = records.caption.steps = 1;
  std::strcpy(records.caption.lines[0].text, "Range down: key E");
  return records;
}

// Each container, and each large element of an array of containers.
std::vector<OverlaidSession::Part> OverlaidSession::parts() {
  std::vector<Part> parts;
  for_each_container([&]<class Whole>(const Container& one, Whole SessionLayout::*) {
    std::size_t count = 1;
    if constexpr (requires { std::tuple_size<Whole>::value; })
      if (sizeof(typename Whole::value_type) >= kLarge_bytes) count = std::tuple_size_v<Whole>;
    for (std::size_t i = 0, size = sizeof(Whole) / count; i < count; ++i)
      parts.push_back({one.offset + i * size, size});
  });
  return parts;
}

void OverlaidSession::lay_raw(std::size_t what, std::size_t offset, std::span<const std::uint8_t> bytes) {
  const Part& part = parts_[what % parts_.size()];
  offset %= part.size;
  const std::size_t length = std::min(bytes.size(), part.size - offset);
  std::memcpy(memory() + part.offset + offset, bytes.data(), length);
  remember(part.offset + offset, length);
}

void OverlaidSession::publish(std::size_t what, std::size_t offset, std::span<const std::uint8_t> bytes) {
  SessionLayout& to = layout();
  constexpr std::size_t kKinds = 17;
  const std::size_t lane = what / kKinds % kOwnshipLanes;
  const auto with = [&](auto& record) -> auto& {
    lay(record, offset, bytes);
    return record;
  };
  const auto ring = [this](auto& into, const auto& record) {
    using Ring = std::remove_cvref_t<decltype(into)>;
    const auto at = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&into) - memory());
    remember(at + Ring::slots_offset() + into.publish(record) % Ring::kDepth * Ring::slot_stride(),
             Ring::slot_stride());
  };
  switch (what % kKinds) {
    case 0:
      return to.clock.publish(with(records_.clock));
    case 1:
      return to.ownship[lane].publish(with(records_.ownship[lane]));
    case 2:
      return to.nav[lane].publish(with(records_.nav[lane]));
    case 3:
      return to.radar_state.publish(with(records_.state));
    case 4:
      return to.model_status.publish(with(records_.status));
    case 5:
      return to.outputs.publish(with(records_.outputs));
    case 6:
      return to.recorder_status.publish(with(records_.recorder));
    case 7:
      return ring(to.model_ticks, with(records_.tick));
    case 8:
      return ring(to.applied_events, with(records_.applied));
    case 9:
      return ring(to.sweeps, with(records_.sweep));
    case 10:
      to.input.push(lane, with(records_.event));
      break;
    case 11:
      return to.traffic.publish(with(records_.traffic));
    case 12: {
      static const std::vector<std::uint8_t> pixels(kMaxPatchPixels * kMaxPatchPixels, 128);
      // Replaces a map that an earlier piece of the input published with the same id.
      publish_patch(to, with(records_.map), pixels, {});
      break;
    }
    case 13: {
      static const std::vector<std::uint8_t> pixels(4UL * kMaxFramePixels * kMaxFramePixels, 128);
      publish_frame(to, with(records_.frame), pixels);
      break;
    }
    case 14:
      to.notes.append(with(records_.note));
      break;
    case 15:
      return to.world.publish(with(records_.world));
    default:
      return to.caption.publish(with(records_.caption));
  }
}

void OverlaidSession::remember_rings() {
  SessionLayout& whole = layout();
  next_ = {whole.model_ticks.next(), whole.applied_events.next(), whole.sweeps.next(), whole.traffic_latched.next()};
}

void OverlaidSession::put_back() {
  SessionLayout& whole = layout();
  // Small parts are restored as a whole, rings where records were published, pictures without their pixels.
  const std::size_t rings = offsetof(SessionLayout, model_ticks), input = offsetof(SessionLayout, input),
                    patches = offsetof(SessionLayout, patches), traffic = offsetof(SessionLayout, traffic),
                    latched = offsetof(SessionLayout, traffic_latched);
  remember(offsetof(SessionLayout, lockstep), rings - offsetof(SessionLayout, lockstep));
  remember(input, patches - input);
  remember(traffic, latched - traffic);
  remember(offsetof(SessionLayout, counters), offsetof(SessionLayout, spare) - offsetof(SessionLayout, counters));
  for (std::size_t slot = 0; slot < kPatchSlots; ++slot)
    remember(patches + slot * sizeof(PatchSlot), offsetof(PatchSlot, pixels));
  for (std::size_t slot = 0; slot < kFrameSlots; ++slot)
    remember(offsetof(SessionLayout, frames) + slot * sizeof(FrameSlot), offsetof(FrameSlot, pixels));
  const auto remember_ring = [this](std::size_t at, const auto& ring, std::uint64_t began) {
    using Ring = std::remove_cvref_t<decltype(ring)>;
    const std::size_t stride = Ring::slot_stride();
    remember(at, Ring::slots_offset());
    for (std::uint64_t n = 0; n < kMaxPublished; ++n)
      remember(at + Ring::slots_offset() + (began + n) % Ring::kDepth * stride, stride);
  };
  remember_ring(rings, whole.model_ticks, next_[0]);
  remember_ring(offsetof(SessionLayout, applied_events), whole.applied_events, next_[1]);
  remember_ring(offsetof(SessionLayout, sweeps), whole.sweeps, next_[2]);
  remember_ring(latched, whole.traffic_latched, next_[3]);
  for (const Part& part : touched_) std::memcpy(memory() + part.offset, before_.data() + part.offset, part.size);
  touched_.clear();
}

}  // namespace yars::fuzz
