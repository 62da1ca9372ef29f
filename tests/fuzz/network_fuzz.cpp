// Any samples from the network, into a segment with any bytes: the exchanges of a gateway take or refuse each, and
// publish no record out of range. DDS itself, which reads the packets, is not part of this target.
// The input consists of two parts. The first two bytes are the length of the first part, the third its mode: bit 0:
// this host has the state machine; bit 1: lockstep; bit 2: this host has the radar model. The first part consists of
// pieces of (topic and host, offset in two bytes, length, bytes): a well-formed sample that the bytes overwrite. An
// even offset makes the sample's hash or number right again. The second part changes the segment
// (tests/fuzz/overlaid_session.hpp); each beat takes some samples.
#include <unistd.h>

#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "gateway/exchange/clock_exchange.hpp"
#include "gateway/exchange/event_exchange.hpp"
#include "gateway/exchange/lockstep_exchange.hpp"
#include "gateway/exchange/model_exchange.hpp"
#include "gateway/exchange/state_exchange.hpp"
#include "gateway/exchange/world_exchange.hpp"
#include "lib/error/error.hpp"
#include "lib/log/log.hpp"
#include "tests/fuzz/network_samples.hpp"
#include "tests/fuzz/overlaid_session.hpp"

namespace {

using namespace yars;
using namespace yars::gateway;
using databuffer::Role;
using fuzz::kHostNames;
using fuzz::kSegment;

constexpr std::size_t kSamplesOfABeat = 8;

void require_good(const databuffer::Refusal& refusal) {
  YARS_REQUIRE(refusal.value_or(""), ==, "");
}

// What stands in the containers that a gateway writes, to see what one beat has published.
class Published {
 public:
  explicit Published(const databuffer::SessionLayout& layout) : layout_(&layout), before_(numbers()), ids_(ids()) {
    for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane) pushed_[lane] = layout.input.pushed(lane);
  }
  void check() const {
    const auto after = numbers();
    std::size_t index = 0;
    const auto slot = [&](const auto& from, auto record) {
      const bool changed = before_[index] != after[index];
      ++index;
      if (changed && from.read(record)) require_good(databuffer::validate(record));
    };
    slot(layout_->radar_state, databuffer::RadarState{});
    slot(layout_->outputs, databuffer::Outputs{});
    slot(layout_->advice, databuffer::PilotAdvice{});
    slot(layout_->model_status, databuffer::ModelStatus{});
    slot(layout_->traffic, databuffer::Traffic{});
    slot(layout_->caption, databuffer::Caption{});
    slot(layout_->recorder_status, databuffer::RecorderStatus{});
    for (const auto& lane : layout_->ownship) slot(lane, databuffer::Ownship{});
    for (const auto& lane : layout_->nav) slot(lane, databuffer::Nav{});
    slot(layout_->world, databuffer::WorldState{});
    slot(layout_->world_configured, databuffer::WorldState{});
    const auto ring = [&](const auto& from, auto record, const auto& validate) {
      for (std::uint64_t cursor = before_[index]; cursor != after[index];) {
        const std::uint64_t number = cursor;
        if (!from.read(cursor, record).delivered || cursor == number) break;
        require_good(validate(record));
      }
      ++index;
    };
    const auto any = [](const auto& record) { return databuffer::validate(record); };
    const auto timed = [](const auto& record) {
      YARS_REQUIRE(record.sim_time_ns, ==, record.tick * radar::kTickNanoseconds);
      return databuffer::validate(record);
    };
    ring(layout_->model_ticks, databuffer::ModelTick{}, timed);
    ring(layout_->sweeps, databuffer::Sweep{}, timed);
    ring(layout_->traffic_latched, databuffer::Traffic{}, any);
    ring(layout_->applied_events, databuffer::AppliedEvent{}, any);
    ring(layout_->world_latched, databuffer::WorldState{}, any);
    check_lanes();
    check_maps();
  }

 private:
  static constexpr std::size_t kContainers = 7 + 2 * databuffer::kOwnshipLanes + 2 + 5;
  std::array<std::uint64_t, kContainers> numbers() const {
    std::array<std::uint64_t, kContainers> all{layout_->radar_state.version(),    layout_->outputs.version(),
                                               layout_->advice.version(),         layout_->model_status.version(),
                                               layout_->traffic.version(),        layout_->caption.version(),
                                               layout_->recorder_status.version()};
    std::size_t index = 7;
    for (const auto& lane : layout_->ownship) all[index++] = lane.version();
    for (const auto& lane : layout_->nav) all[index++] = lane.version();
    all[index++] = layout_->world.version();
    all[index++] = layout_->world_configured.version();
    for (const std::uint64_t next :
         {layout_->model_ticks.next(), layout_->sweeps.next(), layout_->traffic_latched.next(),
          layout_->applied_events.next(), layout_->world_latched.next()})
      all[index++] = next;
    return all;
  }
  std::array<std::uint64_t, databuffer::kPatchSlots> ids() const {
    std::array<std::uint64_t, databuffer::kPatchSlots> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = layout_->patches[i].id.load();
    return all;
  }
  // A lane gets valid events, and no more than it has room for.
  void check_lanes() const {
    for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane) {
      const std::uint64_t pushed = layout_->input.pushed(lane);
      if (pushed == pushed_[lane]) continue;
      YARS_REQUIRE(pushed - pushed_[lane], <=, kSamplesOfABeat);
      YARS_REQUIRE(pushed - layout_->input.popped(lane), <=, databuffer::kInputLaneDepth);
      databuffer::InputEvent event{};
      for (std::uint64_t number = pushed_[lane]; number != pushed; ++number)
        if (layout_->input.peek_at(lane, number, event)) require_good(databuffer::validate(event));
    }
  }
  void check_maps() const {
    const auto after = ids();
    databuffer::PatchMap map{};
    std::vector<std::uint8_t> pixels;
    for (std::size_t i = 0; i < after.size(); ++i)
      if (after[i] != ids_[i] && databuffer::read_patch(*layout_, after[i], map, pixels)) {
        require_good(databuffer::validate(map));
        YARS_REQUIRE(databuffer::map_hash(map, pixels), ==, map.hash);
      }
  }

  const databuffer::SessionLayout* layout_;
  std::array<std::uint64_t, kContainers> before_;
  std::array<std::uint64_t, databuffer::kPatchSlots> ids_;
  std::array<std::uint64_t, databuffer::kInputLanes> pushed_{};
};

class Gateway {
 public:
  Gateway(databuffer::Session session, const std::string& name, std::uint8_t mode)
      : session_(std::move(session)),
        hosts_(session_, nullptr, {"alpha", 0, fuzz::kStart, kSegment, 0, 0}),
        roles_(session_, name),
        context_{session_, nullptr, hosts_, roles_} {
    context_.now_ns = databuffer::monotonic_ns();
    context_.lockstep = (mode & 2U) != 0;
    if ((mode & 1U) != 0) hold(Role::state_machine, name);
    if ((mode & 4U) == 0) return;
    hold(Role::radar_model, name);
    session_.layout().world_configured.publish(fuzz::good_world(0));
    session_.layout().world_latched.publish(fuzz::good_world(0));
  }

  void beat(std::span<const std::uint8_t>& input) {
    const Published published(session_.layout());
    for (std::size_t i = 0; i < kSamplesOfABeat && input.size() >= 4; ++i) {
      const std::size_t length = std::min<std::size_t>(input[3], input.size() - 4);
      receive(input[0], input[1] * 256U + input[2], input.subspan(4, length));
      input = input.subspan(4 + length);
    }
    pass();
    published.check();
    require_good(databuffer::validate(session_.clock()));
    YARS_REQUIRE(hosts_.views().size(), <=, databuffer::kMaxHosts);
    databuffer::NetworkStatus status{};
    hosts_.describe(status, context_.now_ns);
    require_good(databuffer::validate(status));
  }

 private:
  // A local process has the role.
  void hold(Role role, const std::string& name) {
    auto session = databuffer::Session::open(name, databuffer::name_of(role));
    if (!session) return;
    auto& holder = holders_.emplace_back(std::move(*session), std::nullopt);
    if (auto claim = holder.first.claim(role)) holder.second.emplace(std::move(*claim));
  }
  template <class Exchange>
  auto to(Exchange& exchange) {
    return [this, &exchange](const auto& sample) { exchange.receive(context_, sample); };
  }
  template <class Sample, class Take>
  void take(std::size_t host, std::size_t offset, std::span<const std::uint8_t> bytes, const Take& take) {
    Sample sample{};
    if constexpr (requires { sample.host; }) {
      sample.host = host_id(kHostNames[host]);
      sample.start = 77;
      sample.number = numbers_[host][dds::index_of(dds::kTopicOf<Sample>)]++;
    }
    fuzz::fill(sample, host);
    const bool mends = offset % 2 == 0;
    offset = offset / 2 % sizeof sample;
    std::memcpy(reinterpret_cast<char*>(&sample) + offset, bytes.data(),
                std::min(bytes.size(), sizeof sample - offset));
    if constexpr (std::is_same_v<Sample, yars_net_SweepSample>) {
      sample.video._length = std::min<std::uint32_t>(sample.video._length, radar::kMaxSamples);
      sample.video._buffer = const_cast<std::uint8_t*>(fuzz::bytes().data());
    }
    if (mends) fuzz::mend(sample);
    take(sample);
  }

  void receive(std::size_t what, std::size_t offset, std::span<const std::uint8_t> bytes) {
    const std::size_t host = what / dds::kTopicCount % kHostNames.size();
    switch (static_cast<dds::Topic>(what % dds::kTopicCount)) {
      case dds::Topic::hosts:
        return take<yars_net_HostSample>(host, offset, bytes, [this](const auto& sample) {
          hosts_.receive(sample, sample.version[31] != 'e', context_.now_ns);
        });
      case dds::Topic::probes:
        return take<yars_net_ProbeSample>(
            host, offset, bytes, [this](const auto& sample) { hosts_.receive(sample, databuffer::monotonic_ns()); });
      case dds::Topic::clock:
        return take<yars_net_ClockSample>(host, offset, bytes, to(clock_));
      case dds::Topic::clock_requests:
        return take<yars_net_ClockRequestSample>(host, offset, bytes, to(clock_));
      case dds::Topic::ownship:
        return take<yars_net_OwnshipSample>(host, offset, bytes, to(states_));
      case dds::Topic::input_events:
        return take<yars_net_InputEventSample>(host, offset, bytes, to(events_));
      case dds::Topic::event_receipts:
        return take<yars_net_EventReceiptSample>(host, offset, bytes, to(events_));
      case dds::Topic::applied_events:
        return take<yars_net_AppliedEventSample>(host, offset, bytes, to(events_));
      case dds::Topic::radar_state:
        return take<yars_net_RadarStateSample>(host, offset, bytes, to(states_));
      case dds::Topic::outputs:
        return take<yars_net_OutputsSample>(host, offset, bytes, to(states_));
      case dds::Topic::advice:
        return take<yars_net_AdviceSample>(host, offset, bytes, to(states_));
      case dds::Topic::model_status:
        return take<yars_net_ModelStatusSample>(host, offset, bytes, to(states_));
      case dds::Topic::model_ticks:
        return take<yars_net_ModelTickSample>(host, offset, bytes, to(history_));
      case dds::Topic::sweeps:
        return take<yars_net_SweepSample>(host, offset, bytes, to(history_));
      case dds::Topic::traffic:
        return take<yars_net_TrafficSample>(host, offset, bytes, to(states_));
      case dds::Topic::traffic_latched:
        return take<yars_net_LatchedTrafficSample>(host, offset, bytes, to(history_));
      case dds::Topic::patch_maps:
        return take<yars_net_PatchMapSample>(host, offset, bytes, to(maps_));
      case dds::Topic::patch_rows:
        return take<yars_net_PatchRowSample>(host, offset, bytes, to(maps_));
      case dds::Topic::captions:
        return take<yars_net_CaptionSample>(host, offset, bytes, to(states_));
      case dds::Topic::recorder_status:
        return take<yars_net_RecorderStatusSample>(host, offset, bytes, to(states_));
      case dds::Topic::lockstep:
        return take<yars_net_LockstepSample>(host, offset, bytes, to(lockstep_));
      case dds::Topic::world:
        return take<yars_net_WorldSample>(host, offset, bytes, to(world_));
      case dds::Topic::world_latched:
        return take<yars_net_LatchedWorldSample>(host, offset, bytes, to(world_));
      case dds::Topic::world_requests:
        return take<yars_net_WorldRequestSample>(host, offset, bytes, to(world_));
    }
  }
  // As GatewayShell::pass(), without the link.
  void pass() {
    context_.now_ns += pass_ns_;
    pass_ns_ = pass_ns_ > 20'000'000'000 ? 5'000'000 : pass_ns_ * 6;
    hosts_.set_claims(roles_.held_roles(), clock_.owns(), session_.clock().epoch);
    hosts_.exchange(context_.now_ns);
    roles_.update(hosts_, context_.now_ns);
    roles_.heartbeat();
    clock_.exchange(context_);
    lockstep_.begin_pass(context_);
    states_.keep_lane(context_);
    world_.publish(context_);
    history_.publish(context_);
    maps_.publish(context_);
    lockstep_.apply(context_, history_.is_empty());
    events_.send(context_);
    world_.send(context_);
    lockstep_.send(context_);
  }

  databuffer::Session session_;
  std::deque<std::pair<databuffer::Session, std::optional<databuffer::Claim>>> holders_;
  Hosts hosts_;
  Roles roles_;
  Context context_;
  LaneNames lanes_;
  ClockExchange clock_;
  StateExchange states_{lanes_};
  EventExchange events_{lanes_};
  WorldNumbers world_numbers_;
  WorldExchange world_{world_numbers_};
  HistoryExchange history_{lanes_, world_numbers_};
  MapExchange maps_{500};
  LockstepExchange lockstep_;
  std::array<std::array<std::uint64_t, dds::kTopicCount>, kHostNames.size()> numbers_{};
  std::int64_t pass_ns_ = 5'000'000;
};

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*count*/, char*** /*arguments*/) {
  log::start("fuzz", "off");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::OverlaidSession session("fuzz-" + std::to_string(getpid()));
  if (size < 3) return 0;
  const std::span<const std::uint8_t> rest(data + 3, size - 3);
  const std::size_t split = std::min<std::size_t>(data[0] * 256U + data[1], rest.size());
  std::span<const std::uint8_t> samples = rest.first(split);
  std::optional<Gateway> gateway;
  session.play(rest.subspan(split), [&] {
    // A session with an invalid clock cannot be opened.
    if (!gateway)
      if (auto opened = databuffer::Session::open(session.name(), "gateway"))
        gateway.emplace(std::move(*opened), session.name(), data[2]);
    if (gateway) gateway->beat(samples);
  });
  gateway.reset();
  session.put_back();
  return 0;
}
