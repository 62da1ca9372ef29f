// Readers that copy a record from the segment, validate it, and keep the last valid one (trust boundary). Inputs that a
// consumer latches once a tick: ownship and nav of the selected lane, and surface traffic.
// Inputs: LatestValue containers of the session's layout ("slots" below), or a function that copies a patch map;
// ownship lanes, nav lanes and traffic of the segment; sim time and epoch of the tick.
// Outputs: the last valid record; true if the record is new; the selected ownship and nav; the latched traffic.
// Errors: an invalid record is refused with a reason, and counted. The last valid record stays in use.
// Units: times [ns]. The age of a record is measured in sim time, with and without lockstep. Threads: one thread per
// reader. The writer of a slot is never blocked. select_ownship is pure. JumpGuard has a state, but reads no clock.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "databuffer/messages/world_state.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"
#include "lib/log/log.hpp"
#include "shm/latest_value.hpp"

namespace yars::databuffer {

// The last valid record of one slot, as one reader sees it.
template <class T>
class Validated {
 public:
  // Copies and validates the slot's record if this reader has not examined it before. True if the record is new and
  // valid.
  bool refresh(const shm::LatestValue<T>& slot) {
    refusal_.reset();
    if (slot.version() == version_) return false;
    T next{};
    const auto version = slot.read(next);
    if (!version) return false;
    version_ = *version;
    refusal_ = validate(next);
    if (refusal_) return false;
    value_ = next;
    has_value_ = true;
    return true;
  }
  // As above, and writes a refusal to the flight recorder as "NAME: REASON".
  bool refresh(const shm::LatestValue<T>& slot, Session& session, const std::string& name) {
    const bool is_new = refresh(slot);
    if (refusal_) session.note(NoteKind::refusal, name + ": " + *refusal_);
    return is_new;
  }

  bool has_value() const { return has_value_; }
  const T& value() const { return value_; }  // all zero while has_value() is false
  // Reason why the last refresh() refused a record; nullopt: no refusal.
  const Refusal& refusal() const { return refusal_; }
  std::uint64_t version() const { return version_; }  // version of the last examined record, valid or not

 private:
  T value_{};
  bool has_value_ = false;
  std::uint64_t version_ = 0;
  Refusal refusal_;
};

// Current record of a slot; nullopt if the slot is empty, if the record is invalid, or if the writer changed the slot
// during every attempt to read it.
template <class T>
std::optional<T> read_valid(const shm::LatestValue<T>& slot) {
  T value{};
  if (!slot.read(value) || validate(value)) return std::nullopt;
  return value;
}

// Record from which a restarted role resumes. An invalid record is reported (flight recorder, log) and ignored.
template <class T>
std::optional<T> read_to_resume(const shm::LatestValue<T>& slot, Session& session, const std::string& name) {
  Validated<T> record;
  if (record.refresh(slot)) return record.value();
  if (!record.refusal()) return std::nullopt;
  session.note(NoteKind::refusal, name + " of the earlier process: " + *record.refusal());
  log::warning(name + " of the earlier process is refused, the program starts without it: " + *record.refusal());
  return std::nullopt;
}

// Reader of the patch maps that one program needs. The caller stores the records. A map that was read is not read again
// while its id stays in `wanted`.
class WantedMaps {
 public:
  // `name`: beginning of the flight recorder's line about an invalid map.
  WantedMaps(Session& session, std::string name) : session_(&session), name_(std::move(name)) {}

  // Clears the records in `maps` with ids that are not in `wanted`, and reads the missing maps. Id 0 in `wanted` is
  // skipped. `maps` has at least as many entries as `wanted`; an entry with id 0 is free. read(id, map) copies a map;
  // false: the pool no longer has it. take(map) receives each new valid map.
  template <class Read, class Take>
  void refresh(std::span<PatchMap> maps, std::span<const std::uint64_t> wanted, const Read& read, const Take& take) {
    for (PatchMap& map : maps)
      if (std::ranges::find(wanted, map.id) == wanted.end()) map = {};
    std::erase_if(refused_ids_, [&](std::uint64_t id) { return std::ranges::find(wanted, id) == wanted.end(); });
    for (const std::uint64_t id : wanted) {
      if (id == 0 || std::ranges::find(refused_ids_, id) != refused_ids_.end() ||
          std::ranges::find(maps, id, &PatchMap::id) != maps.end())
        continue;
      PatchMap next{};
      if (!read(id, next)) continue;
      if (const auto reason = validate(next)) {
        refused_ids_.push_back(id);
        session_->note(NoteKind::refusal, name_ + ": " + *reason);
        continue;
      }
      *std::ranges::find(maps, std::uint64_t{0}, &PatchMap::id) = next;
      take(next);
    }
  }

 private:
  Session* session_;
  std::string name_;
  std::vector<std::uint64_t> refused_ids_;  // ids in `wanted` of invalid maps, which are not read again
};

// [ns] Age of the newest record above which its ownship lane is stale: 25 records of a 50 Hz source. With a shorter
// time a loaded machine would lose its source. With a longer time a dead source would stay in use.
inline constexpr std::int64_t kStaleAfter_ns = 500'000'000;
// [ns] Time for which a lane must deliver without a gap before it replaces a fresh lane. A gap is a pause longer than
// kStaleAfter_ns.
inline constexpr std::int64_t kTakeoverAfter_ns = 250'000'000;

struct OwnshipLane {
  bool present = false;        // the lane has a value, and a valid value was received since the lane was last empty
  std::uint32_t priority = 0;  // higher wins
  std::uint64_t version = 0;   // changes with each accepted record
};

// Result of select_ownship(), and input of its next call. The first call gets a default-constructed OwnshipSelection.
struct OwnshipSelection {
  struct Memory {
    bool known = false;  // true after the first call
    std::uint64_t version = 0;
    std::optional<std::int64_t> received_ns;  // arrival of the newest version
    std::int64_t delivering_since_ns = 0;     // first arrival after the last gap
  };
  std::optional<std::size_t> lane;
  std::array<Memory, kOwnshipLanes> memory;
};

// Selects the ownship lane to use: the fresh lane of the highest priority, with hysteresis. Pure; call once a tick.
// A lane is fresh while its version has changed within kStaleAfter_ns by the caller's clock; stamps of sources are not
// used. The version that the first call finds in a lane does not count as a change, because a dead writer may have left
// it. A lane of higher priority replaces the selected one after gap-free delivery for kTakeoverAfter_ns. Otherwise the
// selected lane is kept until it is stale. Lanes with such delivery then come before other fresh lanes. At equal
// priority the selected lane stays; if none is selected, the lower index wins. `lanes`: at most kOwnshipLanes entries,
// always in the same order. `now_ns`: time of any clock; OwnshipReceiver passes sim time. When this clock goes back,
// later arrival times are set to the new time.
OwnshipSelection select_ownship(std::span<const OwnshipLane> lanes, std::int64_t now_ns,
                                const OwnshipSelection& previous);

// [m] Tolerance added to the distance that an aircraft flies at twice its speed. It covers the noise of a navigator.
inline constexpr double kPositionTolerance_m = 50.0;
// [ns] Sim time for which a jump must persist before it is proven. With a shorter time one bad record could move the
// radar.
inline constexpr std::int64_t kJumpProof_ns = 100'000'000;
// [ns] Sim time for which a jump without a new epoch is held back. If no process sets the clock, the ownship stands
// still for this time.
inline constexpr std::int64_t kMaxHold_ns = 1'000'000'000;

// Detector of position jumps. A record is a jump if it is farther from the last accepted position than an aircraft can
// fly at twice its speed, plus kPositionTolerance_m, for example after a change of the source. A jump is accepted with
// a new epoch, which restarts scan and filters. Either the record is the first one of the new epoch, or the epoch
// changes while the jump is held. While a jump is held, the previous record stays in use. A process that may set the
// clock raises the epoch when is_proven(). If no process does so, the jump is accepted after kMaxHold_ns.
class JumpGuard {
 public:
  // True if `next`, received at `received_ns`, is to be used at the tick with sim time `now_ns`. Call once a tick.
  bool accepts(const Ownship& next, std::int64_t received_ns, std::int64_t now_ns, std::uint32_t epoch);
  // True if the held jump has persisted for kJumpProof_ns.
  bool is_proven() const { return proven_; }
  std::uint64_t abandoned() const { return abandoned_; }  // jumps that ended before they were accepted

 private:
  bool is_jump(const Ownship& next, std::int64_t received_ns) const;
  void take(const Ownship& next, std::int64_t received_ns);

  std::optional<Ownship> last_;  // last accepted record
  std::int64_t last_received_ns_ = 0;
  std::optional<std::int64_t> held_since_ns_;
  std::uint32_t held_epoch_ = 0;
  bool proven_ = false;
  std::uint64_t abandoned_ = 0;
};

inline constexpr std::uint32_t kNoLane = 0xffffffffU;

// Name of a source for messages: Ownship::source, or the lane number if this field is empty.
std::string name_of_source(const Ownship& ownship, std::uint32_t lane);

// Latches the ownship and nav of the lane that select_ownship() returns. Records that fail validate() are refused and
// counted; the lane's last valid record stays in use. A position jump within an epoch is held back (JumpGuard), except
// in lockstep, where no process can set the clock.
class OwnshipReceiver {
 public:
  struct Selected {
    bool valid = false;  // select_ownship() has selected a lane
    std::uint32_t lane = kNoLane;
    Ownship ownship{};  // record of the lane; the last used record while no lane is fresh or a jump is held
    Nav nav{};
    std::int64_t received_ns = 0;  // [ns] sim time of the tick that first received `ownship`
    // Record of the new position while a jump is held and proven (JumpGuard). A new epoch makes the guard accept it.
    std::optional<Ownship> jump;
    std::uint32_t jump_lane = kNoLane;  // lane of `jump`
  };
  // `sim_time_ns`: sim time of the tick. `epoch`: epoch of the session at this tick.
  const Selected& refresh(const SessionLayout& layout, std::int64_t sim_time_ns, std::uint32_t epoch);

  // Number of invalid records and abandoned jumps.
  std::uint64_t refused() const { return refused_ + guard_.abandoned(); }
  // Reasons for the refusals of the last refresh(), one per record.
  const std::vector<std::string>& refusals() const { return refusals_; }

 private:
  void receive(const SessionLayout& layout, std::size_t lane);

  struct Lane {
    std::uint64_t accepted = 0;  // number of valid records; select_ownship() uses it as the version
    Validated<Ownship> ownship;
    Validated<Nav> nav;
  };
  std::array<Lane, kOwnshipLanes> lanes_;
  OwnshipSelection selection_;
  JumpGuard guard_;
  Selected selected_;
  std::uint64_t refused_ = 0;
  std::vector<std::string> refusals_;
};

// Latches the surface traffic (ships and vehicles from another program) once a tick. A record that fails validate() or
// has another epoch is refused and counted. The previous record stays in use until it is older than kTrafficStaleAfter,
// a new epoch begins, or the traffic lane of the segment is cleared.
class TrafficReceiver {
 public:
  // True if latched() has changed: a new record arrived, or the previous one went out of use and was cleared.
  bool refresh(const SessionLayout& layout, std::int64_t tick, std::int64_t sim_time_ns, std::uint32_t epoch);
  const Traffic& latched() const { return latched_; }

  std::uint64_t refused() const { return refused_; }
  const std::optional<std::string>& refusal() const { return refusal_; }  // from the last refresh()

 private:
  bool take(const SessionLayout& layout, std::uint32_t epoch);

  Traffic latched_{};
  Validated<Traffic> newest_;
  std::int64_t received_ns_ = 0;
  std::uint64_t refused_ = 0;
  std::optional<std::string> refusal_;
};

}  // namespace yars::databuffer
