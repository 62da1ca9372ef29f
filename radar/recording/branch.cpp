#include "radar/recording/branch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace yars::recording {

namespace {

using databuffer::ModelStatus;
using databuffer::ModelTick;
using databuffer::RadarState;

// [ticks] Distance in the file between a tick and the other records of its time. The recorder writes ticks, events,
// states and sweeps of one poll one after the other, and a loaded machine delays its polls.
constexpr std::int64_t kWindow_ticks = 400;  // 2 s
constexpr std::size_t kMinBlocksBefore = 2;  // blocks read before that of the tick, whatever their ticks

// Tick of a record. nullopt: the record has none.
template <class T>
std::optional<std::int64_t> own_tick(const T& record) {
  if constexpr (requires { record.state.tick; })
    return record.state.tick;
  else
    return tick_of(record);
}

// Epoch of a record. nullopt: the record has none.
template <class T>
std::optional<std::uint32_t> own_epoch(const T& record) {
  if constexpr (requires { record.epoch; })
    return record.epoch;
  else if constexpr (requires { record.status.epoch; })
    return record.status.epoch;
  else if constexpr (requires { record.state.epoch; })
    return record.state.epoch;
  else if constexpr (requires { record.map.epoch; })
    return record.map.epoch;
  else
    return std::nullopt;
}

struct Place {
  std::optional<std::int64_t> tick;
  std::optional<std::uint32_t> epoch;
};

Place place_of(const RecordingItem& item) {
  return std::visit([](const auto& record) { return Place{own_tick(record), own_epoch(record)}; }, item);
}

// True for the records that set the time of the records that follow in the file.
bool sets_time(const RecordingItem& item) {
  return std::holds_alternative<ModelTick>(item) || std::holds_alternative<StartingPoint>(item);
}

// Decides which items belong to a branch, as they come in the order of the file.
class BranchFilter {
 public:
  BranchFilter(std::int64_t tick, std::uint32_t epoch) : tick_(tick), epoch_(epoch) {}

  // Records without a tick belong to the branch up to the first tick after the point.
  bool takes(const RecordingItem& item) {
    const Place place = place_of(item);
    if (sets_time(item)) observe(*place.tick, *place.epoch);
    const std::uint32_t epoch = place.epoch.value_or(epoch_now_);
    if (sets_time(item) && passed_) return false;
    if (epoch != epoch_) return !reached_;
    return place.tick ? *place.tick <= tick_ : !passed_;
  }
  // True if no later item belongs to the branch.
  bool done() const { return done_; }

 private:
  void observe(std::int64_t tick, std::uint32_t epoch) {
    const bool after = reached_ && (epoch != epoch_ || tick > tick_);
    done_ = done_ || (reached_ && epoch != epoch_) || (after && tick > tick_ + kWindow_ticks);
    passed_ = passed_ || after || (epoch == epoch_ && tick > tick_);
    reached_ = reached_ || (epoch == epoch_ && tick <= tick_);
    epoch_now_ = epoch;
  }

  std::int64_t tick_;
  std::uint32_t epoch_;
  std::uint32_t epoch_now_ = 0;
  bool reached_ = false;  // a tick of the epoch up to the point has come
  bool passed_ = false;   // a tick after the point has come
  bool done_ = false;
};

std::string text_of_seconds(std::int64_t tick) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", static_cast<double>(tick) * radar::kTickSeconds);
  return text;
}

// First block of the window before the block of the tick.
std::size_t window_begin(const RecordingReader& reader, std::size_t block, std::int64_t tick) {
  std::size_t begin = block - std::min(block, kMinBlocksBefore);
  while (begin > 0 && reader.blocks()[begin - 1].last_tick <= tick &&
         reader.blocks()[begin - 1].last_tick > tick - kWindow_ticks)
    --begin;
  return begin;
}

// Epoch of the newest tick at or before `tick`, from the block of that tick on. nullopt: only later ticks follow.
std::optional<std::uint32_t> epoch_at(RecordingReader& reader, std::size_t block, std::int64_t tick) {
  std::optional<std::uint32_t> epoch;
  reader.seek_block(block);
  while (const auto item = reader.next()) {
    if (!sets_time(*item)) continue;
    const Place place = place_of(*item);
    if (epoch && (place.epoch != epoch || *place.tick > tick)) break;
    if (!epoch || *place.tick <= tick) epoch = place.epoch;
  }
  return epoch;
}

// Records around the wanted tick, of its epoch, in the order of the file.
struct Window {
  std::vector<std::int64_t> ticks, events;
  std::vector<RadarState> states;
  std::vector<ModelStatus> statuses;
};

Window read_window(RecordingReader& reader, std::size_t first_block, std::int64_t tick, std::uint32_t epoch) {
  Window window;
  reader.seek_block(first_block);
  if (const auto change = reader.last_before<StateChange>()) window.states.push_back(change->state);
  BranchFilter filter(tick + kWindow_ticks, epoch);
  while (const auto item = reader.next()) {
    const bool taken = filter.takes(*item);
    if (filter.done()) break;
    if (!taken || place_of(*item).epoch.value_or(epoch) != epoch) continue;
    if (const auto* model_tick = std::get_if<ModelTick>(&*item)) window.ticks.push_back(model_tick->tick);
    if (const auto* event = std::get_if<databuffer::AppliedEvent>(&*item)) window.events.push_back(event->tick);
    if (const auto* change = std::get_if<StateChange>(&*item)) window.states.push_back(change->state);
    if (const auto* report = std::get_if<StatusReport>(&*item)) window.statuses.push_back(report->status);
    if (const auto* start = std::get_if<StartingPoint>(&*item)) {
      window.statuses.push_back(start->status);
      window.ticks.push_back(start->status.tick);
    }
  }
  return window;
}

const RadarState* state_at(const Window& window, std::int64_t tick) {
  const auto found = std::find_if(window.states.rbegin(), window.states.rend(),
                                  [tick](const RadarState& state) { return state.tick <= tick; });
  return found == window.states.rend() ? nullptr : &*found;
}

// True if the radar state has applied all events up to the tick. An event changes the state in its own tick.
bool has_all_events(const Window& window, const RadarState& state, std::int64_t tick) {
  return std::ranges::none_of(window.events, [&](std::int64_t event) { return event > state.tick && event <= tick; });
}

// The status at which the branch begins; nullptr: none.
const ModelStatus* choose(const Window& window, std::int64_t tick) {
  const ModelStatus *best = nullptr, *newest = nullptr, *next = nullptr;
  for (const ModelStatus& status : window.statuses) {
    const RadarState* state = state_at(window, status.tick);
    if (state == nullptr || std::ranges::find(window.ticks, status.tick) == window.ticks.end()) continue;
    if (status.tick > tick) {
      if (next == nullptr) next = &status;
      continue;
    }
    newest = &status;
    if (has_all_events(window, *state, status.tick)) best = &status;
  }
  if (newest == nullptr) return next;
  constexpr std::int64_t kMaxEarlier_ticks = 60;  // 0.3 s, two statuses
  return best != nullptr && newest->tick - best->tick <= kMaxEarlier_ticks ? best : newest;
}

template <class T>
void take(const RecordingItem& item, std::optional<T>& value) {
  if (const auto* record = std::get_if<T>(&item)) value = *record;
}

// Fills the records of the point that are in force at its tick.
void read_records(RecordingReader& reader, BranchPoint& point) {
  reader.seek_block(point.first_block);
  point.outputs = reader.last_before<databuffer::Outputs>();
  point.traffic = reader.last_before<databuffer::Traffic>();
  point.world = reader.last_before<databuffer::WorldState>();
  auto flight = reader.last_before<FlightSource>();
  BranchFilter filter(point.tick, point.epoch);
  while (const auto item = reader.next()) {
    const bool taken = filter.takes(*item);
    if (filter.done()) break;
    if (!taken) continue;
    take(*item, point.outputs);
    take(*item, point.traffic);
    take(*item, point.world);
    take(*item, flight);
  }
  if (flight) point.flight_source = text_of(*flight);
  if (point.traffic && point.traffic->epoch != point.epoch) point.traffic.reset();
}

}  // namespace

std::optional<TickRange> tick_range(const RecordingReader& reader) {
  std::optional<TickRange> range;
  for (const IndexEntry& block : reader.blocks()) {
    if ((block.kinds >> kKindOf<ModelTick>.number & 1U) == 0) continue;
    if (!range) range = TickRange{block.first_tick, block.last_tick};
    range->first = std::min(range->first, block.first_tick);
    range->last = std::max(range->last, block.last_tick);
  }
  return range;
}

error::Expected<std::int64_t> tick_at(const RecordingReader& reader, double seconds, const std::string& file,
                                      const std::string& option) {
  const auto range = tick_range(reader);
  if (!range) return error::fail(file, "at least one tick", "none", "record while radar-model runs");
  const double tick = std::round(seconds / radar::kTickSeconds);  // NaN fails both comparisons
  if (tick >= static_cast<double>(range->first) && tick <= static_cast<double>(range->last))
    return static_cast<std::int64_t>(tick);
  return tl::unexpected(error::usage_error(
      option,
      "a time within " + file + ", " + text_of_seconds(range->first) + " to " + text_of_seconds(range->last) + " s",
      std::to_string(seconds)));
}

error::Expected<BranchPoint> find_branch_point(RecordingReader& reader, std::int64_t tick, const std::string& file) {
  const std::size_t block = reader.block_of(tick);
  BranchPoint point;
  point.first_block = window_begin(reader, block, tick);
  const auto epoch = epoch_at(reader, block, tick);
  if (!epoch) return error::fail(file, "at least one tick", "none", "record while radar-model runs");
  const Window window = read_window(reader, point.first_block, tick, *epoch);
  const ModelStatus* status = choose(window, tick);
  if (status == nullptr)
    return error::fail(file, "a model status and a radar state at " + text_of_seconds(tick) + " s",
                       window.states.empty() ? "no radar state" : "no model status with its tick",
                       "choose another time, or record with state-machine and radar-model running");
  point.tick = status->tick;
  point.epoch = *epoch;
  point.status = *status;
  point.state = *state_at(window, status->tick);
  read_records(reader, point);
  return point;
}

error::Expected<void> copy_until(RecordingReader& reader, const BranchPoint& point, RecordingWriter& writer) {
  for (std::size_t block = 0; block < point.first_block; ++block) {
    const auto bytes = reader.bytes_of_block(block);
    if (bytes.empty()) continue;
    if (auto written = writer.append_block(bytes, reader.blocks()[block]); !written) return written;
  }
  BranchFilter filter(point.tick, point.epoch);
  reader.seek_block(point.first_block);
  while (const auto item = reader.next()) {
    const bool taken = filter.takes(*item);
    if (filter.done()) break;
    if (!taken) continue;
    if (auto written = std::visit([&](const auto& record) { return writer.append(record); }, *item); !written)
      return written;
  }
  return {};
}

}  // namespace yars::recording
