#include "tests/endtoend/fault_injection/watch.hpp"

#include <charconv>
#include <chrono>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "lib/text/plain_text.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "tests/endtoend/fault_injection/ranges.hpp"
#include "tests/endtoend/fault_injection/witness.h"

namespace yars::endtoend::storm {

namespace {

using databuffer::SessionLayout;

constexpr std::size_t kMaxFaultsTold = 20;
constexpr auto kPause = std::chrono::microseconds(500);
constexpr std::string_view kMark = "mark";

// A value read last, to be compared with a second read of the same version.
template <class Record>
struct Seen {
  Record record{};
  std::uint64_t version = 0;
};

std::optional<std::uint32_t> number_behind(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  std::uint32_t number = 0;
  const auto* end = text.data() + text.size();
  const auto [stopped, problem] = std::from_chars(text.data() + prefix.size(), end, number);
  if (problem != std::errc() || stopped != end) return std::nullopt;
  return number;
}

}  // namespace

struct Watch::Look {
  explicit Look(databuffer::Session opened) : session(std::move(opened)) {
    const SessionLayout& layout = std::as_const(session).layout();
    next_tick = layout.model_ticks.next();
    next_event = layout.applied_events.next();
    next_sweep = layout.sweeps.next();
    next_traffic = layout.traffic_latched.next();
    newest_frame = databuffer::greatest_id<shm::PlainAccess>(layout.frames);
  }
  const SessionLayout& layout() const { return session.layout(); }

  databuffer::Session session;
  std::uint64_t next_tick, next_event, next_sweep, next_traffic, newest_frame;
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
  std::unique_ptr<Look> here;
  auto next_name_look = std::chrono::steady_clock::now();
  while (!ending_) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_name_look) {
      next_name_look = now + std::chrono::milliseconds(50);
      if (!here || !here->session.has_name()) {
        auto opened = databuffer::Session::open_read_only(session);
        if (opened) here = std::make_unique<Look>(std::move(*opened));
      }
    }
    if (here) look(*here);
    std::this_thread::sleep_for(kPause);
  }
}

void Watch::note(std::uint64_t Verdict::*counter, const std::string& what) {
  const std::scoped_lock lock(mutex_);
  ++(verdict_.*counter);
  if (verdict_.first.size() < kMaxFaultsTold) verdict_.first.push_back(what);
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
  if (storm_is_whole(&record, sizeof record) == 0) note(&Verdict::torn, std::string(name) + ": its sum is another");
}

template <class Value, class Memory, class Judge>
void Watch::look_at(const Value& value, Memory& seen, const char* name, const Judge& judge) {
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

void Watch::look(Look& look) {
  look_at_clock(look);
  look_at_rings(look);
  look_at_values(look);
  look_at_pictures(look);
}

// A change of the clock goes on from what the clock before it says for that moment, or begins an epoch.
void Watch::look_at_clock(Look& look) {
  constexpr std::int64_t kRounding_ns = 10'000;  // rates other than 1 are reckoned in doubles
  const databuffer::ClockState before = look.clock.record;
  const bool known = look.clock.version != 0;
  look_at(look.layout().clock, look.clock, "clock", [&](const databuffer::ClockState& clock) {
    refuse(validate(clock), "clock");
    if (!known || clock.epoch != before.epoch) return;
    if (clock.base_sim_ns + kRounding_ns < databuffer::sim_time_at(before, clock.base_monotonic_ns))
      note(&Verdict::time_back, "clock: goes back from " +
                                    std::to_string(databuffer::sim_time_at(before, clock.base_monotonic_ns)) + " to " +
                                    std::to_string(clock.base_sim_ns) + " ns");
  });
}

void Watch::look_at_values(Look& look) {
  const SessionLayout& layout = look.layout();
  look_at(layout.radar_state, look.state, "radar state",
          [&](const databuffer::RadarState& state) { refuse(validate(state), "radar state"); });
  look_at(layout.outputs, look.outputs, "outputs",
          [&](const databuffer::Outputs& outputs) { refuse(why_out_of_range(outputs), "outputs"); });
  look_at(layout.recorder_status, look.recorder, "recorder status",
          [&](const databuffer::RecorderStatus& status) { refuse(validate(status), "recorder status"); });
  look_at(layout.model_status, look.status, "model status", [&](const databuffer::ModelStatus& status) {
    refuse(why_out_of_range(status), "model status");
    if (text::text_of(status.ownship.source) == STORM_SOURCE) witness(status.ownship, "model status' ownship");
    if (status.nav.reserved[0] == STORM_FRAME_MARK) witness(status.nav, "model status' nav");
    flies_ = (status.flags & databuffer::kModelStale) == 0;
    latitude_deg_ = status.ownship.latitude_deg;
    longitude_deg_ = status.ownship.longitude_deg;
  });
  // What a lane holds is its owner's, however bad; only that it is whole is the segment's.
  for (std::size_t lane = 0; lane < databuffer::kOwnshipLanes; ++lane) {
    look_at(layout.ownship[lane], look.ownship[lane], "ownship lane", [&](const databuffer::Ownship& ownship) {
      if (std::memcmp(ownship.source, STORM_SOURCE, sizeof STORM_SOURCE) == 0) witness(ownship, "ownship lane");
    });
    look_at(layout.nav[lane], look.nav[lane], "nav lane", [&](const databuffer::Nav& nav) {
      if (nav.reserved[0] == STORM_FRAME_MARK) witness(nav, "nav lane");
    });
  }
}

void Watch::judge_tick(Look& look, const databuffer::ModelTick& tick) {
  refuse(why_out_of_range(tick), "model tick");
  if (text::text_of(tick.ownship.source) == STORM_SOURCE) witness(tick.ownship, "model tick's ownship");
  if (look.last_tick && look.last_tick->epoch == tick.epoch && tick.tick <= look.last_tick->tick)
    note(&Verdict::time_back, "model tick: " + std::to_string(tick.tick) + " after " +
                                  std::to_string(look.last_tick->tick) + " in one epoch");
  look.last_tick = tick;
}

void Watch::judge_event(const databuffer::AppliedEvent& applied) {
  const databuffer::InputEvent& event = applied.event;
  refuse(validate(event), "applied event");
  const auto text = text::text_of(event.text);
  if (const auto mark = number_behind(text, kMark)) newest_mark_ = *mark;
  const auto number = number_behind(text, STORM_SOURCE);
  if (!number) return;
  const std::scoped_lock lock(mutex_);
  ++verdict_.witnessed;
  if (event.number == *number && event.x == storm_tdc_x(*number) && event.y == storm_tdc_y(*number)) return;
  ++verdict_.torn;
  verdict_.first.push_back("applied event: its number, text and deflections are not of one event");
}

void Watch::look_at_rings(Look& look) {
  const SessionLayout& layout = look.layout();
  std::uint64_t read = 0;
  std::uint64_t hashed = 0;
  for (databuffer::ModelTick tick{}; layout.model_ticks.read(look.next_tick, tick).delivered; ++read)
    judge_tick(look, tick);
  for (databuffer::AppliedEvent event{}; layout.applied_events.read(look.next_event, event).delivered; ++read) {
    ++events_;
    judge_event(event);
  }
  for (; layout.sweeps.read(look.next_sweep, look.sweep).delivered; ++read, ++hashed) {
    ++sweeps_;
    refuse(why_out_of_range(look.sweep), "sweep");
    if (look.sweep.samples > radar::kMaxSamples || model::kernel::sweep_hash(look.sweep) != look.sweep.hash)
      note(&Verdict::torn, "sweep " + std::to_string(look.sweep.number) + ": its hash is another");
  }
  for (databuffer::Traffic traffic{}; layout.traffic_latched.read(look.next_traffic, traffic).delivered; ++read)
    refuse(validate(traffic), "traffic taken over");
  const std::scoped_lock lock(mutex_);
  verdict_.records += read;
  verdict_.witnessed += hashed;
}

void Watch::look_at_pictures(Look& look) {
  const SessionLayout& layout = look.layout();
  for (std::size_t slot = 0; slot < databuffer::kPatchSlots; ++slot) {
    const std::uint64_t id = layout.patches[slot].id;
    databuffer::PatchMap map{};
    if (id == 0 || id == look.maps[slot] || !databuffer::read_patch(layout, id, map, look.pixels)) continue;
    look.maps[slot] = id;
    refuse(validate(map), "patch map");
    {
      const std::scoped_lock lock(mutex_);
      ++verdict_.records, ++verdict_.witnessed;
    }
    if (model::kernel::map_hash(map, look.pixels) != map.hash)
      note(&Verdict::torn, "patch map " + std::to_string(id) + ": its hash is another");
  }
  if (!databuffer::read_newest_frame(layout, look.newest_frame, look.frame, look.pixels)) return;
  look.newest_frame = look.frame.id;
  ++frames_;
  refuse(validate(look.frame), "picture");
  {
    const std::scoped_lock lock(mutex_);
    ++verdict_.records;
  }
  if (look.frame.reserved[0] != STORM_FRAME_MARK) return;
  witness(look.frame, "picture's record");
  for (std::size_t word = 0; word < look.pixels.size() / 8; ++word) {
    std::uint64_t pixels = 0;
    std::memcpy(&pixels, &look.pixels[8 * word], sizeof pixels);
    if (pixels == storm_pixels(look.frame.id, word)) continue;
    note(&Verdict::torn, "picture " + std::to_string(look.frame.id) + ": pixels of another one");
    return;
  }
}

}  // namespace yars::endtoend::storm
