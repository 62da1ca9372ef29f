#include "tests/endtoend/fault_injection/watch.hpp"

#include <charconv>
#include <chrono>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "lib/text/plain_text.hpp"
#include "tests/endtoend/fault_injection/ranges.hpp"
#include "tests/endtoend/fault_injection/witness.h"

namespace yars::endtoend::fault_injection {

// The value read last. A second read of the same version must give the same bytes.
template <class Record>
struct Seen {
  Record record{};
  std::uint64_t version = 0;
};

namespace {

using databuffer::SessionLayout;

constexpr std::size_t kMaxFaultsReported = 20;
constexpr auto kPause = std::chrono::microseconds(500);
constexpr std::string_view kMark = "mark";

// The number after `prefix`, if the text consists of prefix and number.
std::optional<std::uint32_t> number_behind(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  std::uint32_t number = 0;
  const auto* end = text.data() + text.size();
  const auto [stopped, problem] = std::from_chars(text.data() + prefix.size(), end, number);
  if (problem != std::errc() || stopped != end) return std::nullopt;
  return number;
}

}  // namespace

struct Watch::SegmentState {
  explicit SegmentState(databuffer::Session opened) : session(std::move(opened)) {
    const SessionLayout& layout = std::as_const(session).layout();
    next_tick = layout.model_ticks.next();
    next_event = layout.applied_events.next();
    next_sweep = layout.sweeps.next();
    next_traffic = layout.traffic_latched.next();
    next_world = layout.world_latched.next();
    newest_frame = databuffer::greatest_id<shm::PlainAccess>(layout.frames);
  }
  const SessionLayout& layout() const { return session.layout(); }

  databuffer::Session session;
  std::uint64_t next_tick, next_event, next_sweep, next_traffic, next_world, newest_frame;
  std::array<std::uint64_t, databuffer::kPatchSlots> maps{};
  Seen<databuffer::RadarState> state;
  Seen<databuffer::ModelStatus> status;
  Seen<databuffer::Outputs> outputs;
  Seen<databuffer::RecorderStatus> recorder;
  Seen<databuffer::ClockState> clock;
  std::array<Seen<databuffer::Ownship>, databuffer::kOwnshipLanes> ownship;
  std::array<Seen<databuffer::Nav>, databuffer::kOwnshipLanes> nav;
  std::optional<databuffer::ModelTick> last_tick;
  databuffer::Sweep sweep{};
  databuffer::GlassFrame frame{};
  std::vector<std::uint8_t> pixels;
};

Watch::Watch(std::string session) : thread_([this, name = std::move(session)] { run(name); }) {}

Watch::~Watch() {
  ending_ = true;
  thread_.join();
}

Verdict Watch::verdict() const {
  const std::scoped_lock lock(mutex_);
  return verdict_;
}

void Watch::run(const std::string& session) {
  std::unique_ptr<SegmentState> here;
  auto next_name_check = std::chrono::steady_clock::now();
  while (!ending_) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_name_check) {
      next_name_check = now + std::chrono::milliseconds(50);
      if (!here || !here->session.has_name()) {
        auto opened = databuffer::Session::open_read_only(session);
        if (opened) here = std::make_unique<SegmentState>(std::move(*opened));
      }
    }
    if (here) check_all(*here);
    std::this_thread::sleep_for(kPause);
  }
}

void Watch::note(std::uint64_t Verdict::* counter, const std::string& what) {
  const std::scoped_lock lock(mutex_);
  ++(verdict_.*counter);
  if (verdict_.first.size() < kMaxFaultsReported) verdict_.first.push_back(what);
}

void Watch::refuse(const databuffer::Refusal& reason, const char* name) {
  if (reason) note(&Verdict::out_of_range, std::string(name) + ": " + std::string(*reason));
}

template <class Record>
void Watch::witness(const Record& record, const char* name) {
  {
    const std::scoped_lock lock(mutex_);
    ++verdict_.witnessed;
  }
  if (witness_is_whole(&record, sizeof record) == 0) note(&Verdict::torn, std::string(name) + ": wrong checksum");
}

template <class Value, class Memory, class Judge>
void Watch::check_value(const Value& value, Memory& seen, const char* name, const Judge& judge) {
  auto record = seen.record;
  const auto version = value.read(record);
  if (!version) return;
  {
    const std::scoped_lock lock(mutex_);
    ++verdict_.records;
  }
  if (*version == seen.version) {
    if (std::memcmp(&record, &seen.record, sizeof record) != 0)
      note(&Verdict::torn, std::string(name) + ": two reads of version " + std::to_string(*version) + " differ");
    return;
  }
  judge(record);
  std::memcpy(&seen.record, &record, sizeof record);
  seen.version = *version;
}

void Watch::check_all(SegmentState& last) {
  check_clock(last);
  check_rings(last);
  check_values(last);
  check_pictures(last);
}

// A changed clock must not be earlier than the clock before it at the moment of the change, unless it begins an epoch.
void Watch::check_clock(SegmentState& last) {
  constexpr std::int64_t kRounding_ns = 10'000;  // rates other than 1 are computed in double precision
  const databuffer::ClockState before = last.clock.record;
  const bool known = last.clock.version != 0;
  check_value(last.layout().clock, last.clock, "clock", [&](const databuffer::ClockState& clock) {
    refuse(validate(clock), "clock");
    if (!known || clock.epoch != before.epoch) return;
    if (clock.base_sim_ns + kRounding_ns < databuffer::sim_time_at(before, clock.base_monotonic_ns))
      note(&Verdict::time_back, "clock: goes back from " +
                                    std::to_string(databuffer::sim_time_at(before, clock.base_monotonic_ns)) + " to " +
                                    std::to_string(clock.base_sim_ns) + " ns");
  });
}

void Watch::check_values(SegmentState& last) {
  const SessionLayout& layout = last.layout();
  check_value(layout.radar_state, last.state, "radar state",
              [&](const databuffer::RadarState& state) { refuse(validate(state), "radar state"); });
  check_value(layout.outputs, last.outputs, "outputs",
              [&](const databuffer::Outputs& outputs) { refuse(why_out_of_range(outputs), "outputs"); });
  check_value(layout.recorder_status, last.recorder, "recorder status",
              [&](const databuffer::RecorderStatus& status) { refuse(validate(status), "recorder status"); });
  check_value(layout.model_status, last.status, "model status", [&](const databuffer::ModelStatus& status) {
    refuse(why_out_of_range(status), "model status");
    if (text::text_of(status.ownship.source) == FAULT_SOURCE) witness(status.ownship, "model status' ownship");
    if (status.nav.reserved[0] == FAULT_FRAME_MARK) witness(status.nav, "model status' nav");
    flies_ = (status.flags & databuffer::kModelStale) == 0;
    latitude_deg_ = status.ownship.latitude_deg;
    longitude_deg_ = status.ownship.longitude_deg;
  });
  // A lane's owner may write invalid values. Only a torn record is a fault of the segment.
  for (std::size_t lane = 0; lane < databuffer::kOwnshipLanes; ++lane) {
    check_value(layout.ownship[lane], last.ownship[lane], "ownship lane", [&](const databuffer::Ownship& ownship) {
      if (std::memcmp(ownship.source, FAULT_SOURCE, sizeof FAULT_SOURCE) == 0) witness(ownship, "ownship lane");
    });
    check_value(layout.nav[lane], last.nav[lane], "nav lane", [&](const databuffer::Nav& nav) {
      if (nav.reserved[0] == FAULT_FRAME_MARK) witness(nav, "nav lane");
    });
  }
}

void Watch::judge_tick(SegmentState& last, const databuffer::ModelTick& tick) {
  refuse(why_out_of_range(tick), "model tick");
  if (text::text_of(tick.ownship.source) == FAULT_SOURCE) witness(tick.ownship, "model tick's ownship");
  if (last.last_tick && last.last_tick->epoch == tick.epoch && tick.tick <= last.last_tick->tick)
    note(&Verdict::time_back, "model tick: " + std::to_string(tick.tick) + " after " +
                                  std::to_string(last.last_tick->tick) + " in one epoch");
  last.last_tick = tick;
}

void Watch::judge_event(const databuffer::AppliedEvent& applied) {
  const databuffer::InputEvent& event = applied.event;
  refuse(validate(event), "applied event");
  const auto text = text::text_of(event.text);
  if (const auto mark = number_behind(text, kMark)) newest_mark_ = *mark;
  const auto number = number_behind(text, FAULT_SOURCE);
  if (!number) return;
  const std::scoped_lock lock(mutex_);
  ++verdict_.witnessed;
  if (event.number == *number && event.x == witness_tdc_x(*number) && event.y == witness_tdc_y(*number)) return;
  ++verdict_.torn;
  verdict_.first.emplace_back("applied event: its number, text and deflections are of different events");
}

void Watch::check_rings(SegmentState& last) {
  const SessionLayout& layout = last.layout();
  std::uint64_t read = 0;
  std::uint64_t hashed = 0;
  for (databuffer::ModelTick tick{}; layout.model_ticks.read(last.next_tick, tick).delivered; ++read)
    judge_tick(last, tick);
  for (databuffer::AppliedEvent event{}; layout.applied_events.read(last.next_event, event).delivered; ++read) {
    ++events_;
    judge_event(event);
  }
  for (; layout.sweeps.read(last.next_sweep, last.sweep).delivered; ++read, ++hashed) {
    ++sweeps_;
    refuse(why_out_of_range(last.sweep), "sweep");
    if (last.sweep.samples > radar::kMaxSamples || databuffer::sweep_hash(last.sweep) != last.sweep.hash)
      note(&Verdict::torn, "sweep " + std::to_string(last.sweep.number) + ": wrong hash");
  }
  for (databuffer::Traffic traffic{}; layout.traffic_latched.read(last.next_traffic, traffic).delivered; ++read)
    refuse(validate(traffic), "latched traffic");
  for (databuffer::WorldState world{}; layout.world_latched.read(last.next_world, world).delivered; ++read)
    refuse(validate(world), "latched world");
  const std::scoped_lock lock(mutex_);
  verdict_.records += read;
  verdict_.witnessed += hashed;
}

void Watch::check_pictures(SegmentState& last) {
  const SessionLayout& layout = last.layout();
  for (std::size_t slot = 0; slot < databuffer::kPatchSlots; ++slot) {
    const std::uint64_t id = layout.patches[slot].id;
    databuffer::PatchMap map{};
    if (id == 0 || id == last.maps[slot] || !databuffer::read_patch(layout, id, map, last.pixels)) continue;
    last.maps[slot] = id;
    refuse(validate(map), "patch map");
    {
      const std::scoped_lock lock(mutex_);
      ++verdict_.records, ++verdict_.witnessed;
    }
    if (databuffer::map_hash(map, last.pixels) != map.hash)
      note(&Verdict::torn, "patch map " + std::to_string(id) + ": wrong hash");
  }
  if (!databuffer::read_newest_frame(layout, last.newest_frame, last.frame, last.pixels)) return;
  last.newest_frame = last.frame.id;
  ++frames_;
  refuse(validate(last.frame), "picture");
  {
    const std::scoped_lock lock(mutex_);
    ++verdict_.records;
  }
  if (last.frame.reserved[0] != FAULT_FRAME_MARK) return;
  witness(last.frame, "picture's record");
  for (std::size_t word = 0; word < last.pixels.size() / 8; ++word) {
    std::uint64_t pixels = 0;
    std::memcpy(&pixels, &last.pixels[8 * word], sizeof pixels);
    if (pixels == witness_pixels(last.frame.id, word)) continue;
    note(&Verdict::torn, "picture " + std::to_string(last.frame.id) + ": its pixels are of another picture");
    return;
  }
}

}  // namespace yars::endtoend::fault_injection
