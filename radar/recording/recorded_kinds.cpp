#include "radar/recording/recorded_kinds.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace yars::recording {

namespace {

using databuffer::PatchMap;
using databuffer::Sweep;

constexpr std::size_t kSweepFields = offsetof(Sweep, video);  // [bytes]

std::size_t patch_bytes(const PatchMap& map) {
  const std::size_t edge = std::min(map.size, databuffer::kMaxPatchPixels);
  return edge * edge;
}

std::size_t sweep_tail(std::span<const std::byte> fixed) {
  decltype(Sweep::samples) samples = 0;
  std::memcpy(&samples, fixed.data() + offsetof(Sweep, samples), sizeof samples);
  return std::min<std::size_t>(samples, radar::kMaxSamples);
}

std::size_t patch_tail(std::span<const std::byte> fixed) {
  PatchMap map{};
  std::memcpy(&map, fixed.data(), sizeof map);
  return patch_bytes(map);
}

template <class T>
RecordingItem item_from(const RecordParts& parts) {
  T record{};
  std::memcpy(&record, parts.fixed.data(), sizeof record);
  return record;
}

RecordingItem sweep_from(const RecordParts& parts) {
  Sweep sweep{};
  std::memcpy(&sweep, parts.fixed.data(), kSweepFields);
  std::copy_n(reinterpret_cast<const std::uint8_t*>(parts.tail.data()), parts.tail.size(), sweep.video);
  return sweep;
}

RecordingItem patch_from(const RecordParts& parts) {
  Patch patch{};
  std::memcpy(&patch.map, parts.fixed.data(), sizeof patch.map);
  const auto* pixels = reinterpret_cast<const std::uint8_t*>(parts.tail.data());
  patch.pixels.assign(pixels, pixels + parts.tail.size());
  return patch;
}

template <class T>
constexpr RecordedKind row() {
  constexpr KindName name = kKindOf<T>;
  static_assert(name.number >= 1 && name.number <= 63, "a kind is a bit of a 64-bit mask; 0 stands for no kind");
  if constexpr (std::is_same_v<T, Sweep>)
    return {name.number, name.name, name.version, kSweepFields, sweep_tail, sweep_from};
  else if constexpr (std::is_same_v<T, Patch>)
    return {name.number, name.name, name.version, sizeof(PatchMap), patch_tail, patch_from};
  else
    return {name.number, name.name, name.version, sizeof(T), nullptr, item_from<T>};
}

template <class... Ts>
constexpr std::array<RecordedKind, sizeof...(Ts)> rows(const std::variant<Ts...>*) {
  return {row<Ts>()...};
}

constexpr auto kKinds = rows(static_cast<const RecordingItem*>(nullptr));

constexpr bool numbers_differ() {
  for (std::size_t i = 0; i < kKinds.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (kKinds[i].number == kKinds[j].number) return false;
  return true;
}
static_assert(numbers_differ());

}  // namespace

FlightSource flight_source(std::string_view text) {
  FlightSource source{};
  if (text.size() < sizeof source.text) text.copy(source.text, text.size());
  return source;
}

std::string text_of(const FlightSource& source) {
  return {source.text, strnlen(source.text, sizeof source.text)};
}

RecordParts parts_of(const Sweep& sweep) {
  const auto bytes = std::as_bytes(std::span(&sweep, 1));
  return {bytes.first(kSweepFields), bytes.subspan(kSweepFields, sweep_tail(bytes))};
}

RecordParts parts_of(const Patch& patch) {
  const auto pixels = std::as_bytes(std::span(patch.pixels));
  return {std::as_bytes(std::span(&patch.map, 1)), pixels.first(std::min(pixels.size(), patch_bytes(patch.map)))};
}

std::span<const RecordedKind> recorded_kinds() {
  return kKinds;
}

const RecordedKind* recorded_kind(std::uint8_t number) {
  const auto* row = std::find_if(kKinds.begin(), kKinds.end(), [number](const auto& k) { return k.number == number; });
  return row == kKinds.end() ? nullptr : row;
}

namespace {

using databuffer::RadarState;

// The state with its moving values (see StatePace) set to zero. A moving value that this function does not
// set to zero is treated as a switched control: its changes are recorded too often, but never lost.
RadarState without_continuous_values(RadarState state) {
  state.tick = 0;
  state.events_applied = 0;  // events have their own records
  state.cursor_latitude_deg = state.cursor_longitude_deg = state.cursor_elevation_m = 0.0;
  state.cursor_bearing_deg = state.cursor_range_nm = 0.0;
  state.tdc_x = state.tdc_y = 0.0;
  state.cursor_believed_latitude_deg = state.cursor_believed_longitude_deg = 0.0;
  state.cursor_moved_tick = 0;
  state.asked_latitude_deg = state.asked_longitude_deg = 0.0;
  state.update_north_m = state.update_east_m = 0.0;
  state.mission = state.ins = {};
  state.velocity_along_mps = state.velocity_across_mps = state.velocity_vertical_mps = 0.0;
  state.steering_line_deg = state.magnetic_variation_deg = 0.0;
  state.frame_latitude_deg = state.frame_longitude_deg = state.frame_track_deg = 0.0;
  for (databuffer::DrawnPoint& point : state.points) point.latitude_deg = point.longitude_deg = point.elevation_m = 0.0;
  return state;
}

}  // namespace

bool switched(const RadarState& before, const RadarState& after) {
  const RadarState a = without_continuous_values(before), b = without_continuous_values(after);
  return std::memcmp(&a, &b, sizeof a) != 0;
}

bool StatePace::takes(const RadarState& state, std::int64_t tick) {
  if (last_) {
    if (std::memcmp(&*last_, &state, sizeof state) == 0) return false;
    if (!pace_.is_due(tick) && !switched(*last_, state)) return false;
  }
  pace_.taken(tick);
  last_ = state;
  return true;
}

}  // namespace yars::recording
