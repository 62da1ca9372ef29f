// What a recording holds, by kind, and which radar states are worth a record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"

namespace yars::tools::recording {

// What a recording holds, by kind. A kind has a number that never changes its meaning, the record's name for messages,
// and a version that counts up when the record changes its meaning and not its size. One more kind: its number and
// name below, its type at the end of RecordingItem.
// A record is kept as it lies in memory (little-endian): a part of fixed size, then, for sweeps and maps, a tail.

// What identifies a sweep, without its video.
struct SweepMark {
  std::int64_t tick;
  std::uint64_t hash;
  std::uint32_t epoch;
  std::uint32_t number;
  std::uint32_t flags;  // kSweep...
  std::uint32_t reserved;
};

inline SweepMark mark_of(const databuffer::Sweep& sweep) {
  return {sweep.tick, sweep.hash, sweep.epoch, sweep.number, sweep.flags, 0};
}

// The model's status before the ticks that follow: a replay starts from it when recording began mid-run.
struct StartingPoint {
  databuffer::ModelStatus status;
};

// The radar state after a change; state.tick says when.
struct StateChange {
  databuffer::RadarState state;
};

// The model's status now and then.
struct StatusReport {
  databuffer::ModelStatus status;
};

// Records that the recorder was too slow for.
struct Gap {
  std::uint64_t ticks;
  std::uint64_t events;
  std::uint64_t sweeps;
};

// A patch map with its picture: map.size x map.size pixels, rows without padding.
struct Patch {
  databuffer::PatchMap map;
  std::vector<std::uint8_t> pixels;
};

struct KindName {
  std::uint8_t number;  // 1..63
  std::string_view name;
  std::uint16_t version = 1;
};

template <class T>
inline constexpr KindName kKindOf{};
template <>
inline constexpr KindName kKindOf<databuffer::ModelTick>{1, "ModelTick"};
template <>
inline constexpr KindName kKindOf<databuffer::AppliedEvent>{2, "AppliedEvent"};
template <>
inline constexpr KindName kKindOf<SweepMark>{3, "SweepMark"};
template <>
inline constexpr KindName kKindOf<StartingPoint>{4, "StartingPoint"};
template <>
inline constexpr KindName kKindOf<Gap>{5, "Gap"};
template <>
inline constexpr KindName kKindOf<StateChange>{6, "RadarState"};
template <>
inline constexpr KindName kKindOf<StatusReport>{7, "ModelStatus"};
template <>
inline constexpr KindName kKindOf<databuffer::Nav>{8, "Nav"};
template <>
inline constexpr KindName kKindOf<databuffer::Ownship>{9, "Ownship"};
template <>
inline constexpr KindName kKindOf<databuffer::Sweep>{10, "Sweep"};
template <>
inline constexpr KindName kKindOf<Patch>{11, "PatchMap"};
template <>
inline constexpr KindName kKindOf<databuffer::Outputs>{12, "Outputs"};
template <>
inline constexpr KindName kKindOf<databuffer::RecorderStatus>{13, "RecorderStatus"};

template <>
inline constexpr KindName kKindOf<databuffer::Traffic>{14, "Traffic"};

using RecordingItem = std::variant<databuffer::ModelTick, databuffer::AppliedEvent, SweepMark, StartingPoint, Gap,
                                   StateChange, StatusReport, databuffer::Nav, databuffer::Ownship, databuffer::Sweep,
                                   Patch, databuffer::Outputs, databuffer::RecorderStatus, databuffer::Traffic>;

// A record as it is kept.
struct RecordParts {
  std::span<const std::byte> fixed;
  std::span<const std::byte> tail;
};

template <class T>
RecordParts parts_of(const T& record) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {std::as_bytes(std::span(&record, 1)), {}};
}
RecordParts parts_of(const databuffer::Sweep& sweep);
RecordParts parts_of(const Patch& patch);

// A kind at run time.
struct RecordedKind {
  std::uint8_t number;
  std::string_view name;
  std::uint16_t version;
  std::uint32_t bytes;                                          // of the fixed part
  std::size_t (*tail_bytes)(std::span<const std::byte> fixed);  // nullptr: no record of the kind has a tail
  RecordingItem (*item_from)(const RecordParts& parts);         // of parts with the sizes that belong to them
};

std::span<const RecordedKind> recorded_kinds();
const RecordedKind* recorded_kind(std::uint8_t number);  // nullptr: no such kind

// When the record was made; none for those that do not say, and for the radar state, whose tick is its last change.
template <class T>
std::optional<std::int64_t> tick_of(const T& record) {
  if constexpr (requires { record.tick; })
    return record.tick;
  else if constexpr (requires { record.status.tick; })
    return record.status.tick;
  else if constexpr (requires { record.map.end_tick; })
    return record.map.end_tick;
  else
    return std::nullopt;
}

// Which radar states are worth recording: each one in which something was switched, and of those that only move (the
// cursor, its readouts, what the aircraft carries along) ten a second.
inline constexpr std::int64_t kPaceTicks = 20;  // 0.1 s of sim time

// Whether as much time has passed since the last one, or time has begun anew.
class Pace {
 public:
  bool is_due(std::int64_t tick) const { return !last_ || tick < *last_ || tick - *last_ >= kPaceTicks; }
  void taken(std::int64_t tick) { last_ = tick; }

 private:
  std::optional<std::int64_t> last_;
};

class StatePace {
 public:
  // The newest state at `tick`; true: record it. One that is not recorded is offered again until it is, or is another.
  bool takes(const databuffer::RadarState& state, std::int64_t tick);

 private:
  Pace pace_;
  std::optional<databuffer::RadarState> last_;
};

// Whether the two differ in anything but what moves by itself.
bool switched(const databuffer::RadarState& before, const databuffer::RadarState& after);

}  // namespace yars::tools::recording
