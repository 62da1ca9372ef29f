// Kinds of records in a recording, their conversion to bytes, and the rate limits of recorded states.
// Format: a record is stored as in memory (little endian). It has a part of fixed size; sweeps and maps also have a
// tail of variable size. Source: docs/recordings.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"

namespace yars::recording {

// A kind is a type of record. It has a number with a permanent meaning and a name for messages. The version increases
// when the meaning of the record changes but not its size. To add a kind: add its number and name below, and its type
// at the end of RecordingItem.

// Identity and hash of a sweep, without its video.
struct SweepDigest {
  std::int64_t tick;
  std::uint64_t hash;
  std::uint32_t epoch;
  std::uint32_t number;
  std::uint32_t flags;  // kSweep...
  std::uint32_t reserved;
};

inline SweepDigest digest_of(const databuffer::Sweep& sweep) {
  return {sweep.tick, sweep.hash, sweep.epoch, sweep.number, sweep.flags, 0};
}

// Status of the model before the ticks that follow in the recording. A replay resumes the model from this status. It is
// recorded when writing begins or resumes while the model already runs.
struct StartingPoint {
  databuffer::ModelStatus status;
};

// The radar state, recorded when writing begins and after changes, as StatePace decides. Its tick is state.tick.
struct StateChange {
  databuffer::RadarState state;
};

// Status of the model. At most ten per second of sim time are recorded.
struct StatusReport {
  databuffer::ModelStatus status;
};

// Numbers of published records that were overwritten before the recorder read them.
struct Gap {
  std::uint64_t ticks;
  std::uint64_t events;
  std::uint64_t sweeps;
};

// A patch map with its pixels: map.size x map.size, rows without padding.
struct Patch {
  databuffer::PatchMap map;
  std::vector<std::uint8_t> pixels;
};

// Source of the aircraft's flight, the value of flight-model's --source. A live set that goes on from the recording
// (branch.hpp) continues this flight. Recorded when a file begins, if the recorder knows it.
struct FlightSource {
  char text[1024];  // zero-terminated; relative paths are made absolute
};
FlightSource flight_source(std::string_view text);  // empty if the text is too long
std::string text_of(const FlightSource& source);

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
inline constexpr KindName kKindOf<SweepDigest>{3, "SweepDigest"};
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
template <>
inline constexpr KindName kKindOf<databuffer::WorldState>{15, "WorldState", 2};
template <>
inline constexpr KindName kKindOf<FlightSource>{16, "FlightSource"};

using RecordingItem =
    std::variant<databuffer::ModelTick, databuffer::AppliedEvent, SweepDigest, StartingPoint, Gap, StateChange,
                 StatusReport, databuffer::Nav, databuffer::Ownship, databuffer::Sweep, Patch, databuffer::Outputs,
                 databuffer::RecorderStatus, databuffer::Traffic, databuffer::WorldState, FlightSource>;

// Bytes of a record as stored, in two parts.
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

// Description of a kind at run time.
struct RecordedKind {
  std::uint8_t number;
  std::string_view name;
  std::uint16_t version;
  std::uint32_t bytes;                                          // size of the fixed part
  std::size_t (*tail_bytes)(std::span<const std::byte> fixed);  // nullptr: records of the kind have no tail
  RecordingItem (*item_from)(const RecordParts& parts);         // requires a fixed part and a tail of matching sizes
};

std::span<const RecordedKind> recorded_kinds();
const RecordedKind* recorded_kind(std::uint8_t number);  // nullptr: no such kind

// Tick of the record; for a Patch, the tick at which the map was complete. nullopt: the record has no tick, or is a
// StateChange. The tick of a StateChange, state.tick, is not returned.
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

// Minimum interval [ticks] between recorded values of a kind with a rate limit (radar states, statuses of the model,
// outputs): 0.1 s of sim time. Radar states in which a control was switched are recorded in addition.
inline constexpr std::int64_t kPaceTicks = 20;

// Rate limit: a value is due if none was recorded yet, if kPaceTicks have passed since the last recorded value, or if
// the tick has gone back.
class Pace {
 public:
  bool is_due(std::int64_t tick) const { return !last_ || tick < *last_ || tick - *last_ >= kPaceTicks; }
  void taken(std::int64_t tick) { last_ = tick; }

 private:
  std::optional<std::int64_t> last_;
};

// Rate limit of radar states. Takes every state in which a control was switched. Takes a state that differs only in
// moving values (cursor, its readouts, values that follow the aircraft) at the rate of Pace. Never takes a state equal
// to the last one taken.
class StatePace {
 public:
  // Returns true if this state must be recorded. After false, pass the newest state again at later ticks.
  bool takes(const databuffer::RadarState& state, std::int64_t tick);

 private:
  Pace pace_;
  std::optional<databuffer::RadarState> last_;
};

// True if two states differ in more than their moving values (see StatePace).
bool switched(const databuffer::RadarState& before, const databuffer::RadarState& after);

}  // namespace yars::recording
