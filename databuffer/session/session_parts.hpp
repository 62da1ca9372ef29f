// Parts of a session's segment that are no records, and the sizes of its containers. lib/values/segment.idl has the
// order of all containers.
// Source: docs/shared_memory.md.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "databuffer/messages/caption.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/network_status.hpp"
#include "databuffer/messages/note.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "shm/latest_value.hpp"
#include "shm/ring_buffers.hpp"
#include "shm/segment.hpp"

namespace yars::databuffer {

// Sizes of the layout. A change of one requires a higher kLayoutVersion.
inline constexpr std::size_t kOwnshipLanes = 4;
inline constexpr std::size_t kInputLanes = 16;
inline constexpr std::size_t kInputLaneDepth = 128;
inline constexpr std::size_t kProcesses = 32;
inline constexpr std::size_t kNotes = 1000;
inline constexpr std::size_t kPatchSlots = 8;
inline constexpr std::size_t kLatchedWorlds = 16;
// [bytes] Reserve at the end. New containers go there without a new layout version; older programs still attach.
inline constexpr std::size_t kReserveBytes = std::size_t{1} << 20;

using Priority = std::atomic<std::uint32_t>;
using Count = std::atomic<std::uint64_t>;
using EventLanes = shm::InputLanes<InputEvent, kInputLanes, kInputLaneDepth>;
using FlightRecorder = shm::NoteRing<Note, kNotes>;  // any number of writers

// Number of events since the session began, and CLOCK_MONOTONIC times [ns] of the last 8. Event n has index n mod 8.
struct RecentCount {
  static constexpr std::size_t kTimes = 8;
  std::atomic<std::uint64_t> count;
  std::array<std::atomic<std::int64_t>, kTimes> times_ns;

  void add(std::int64_t now_ns) { times_ns[count.fetch_add(1) % kTimes].store(now_ns); }
  // Number of events less than `span_ns` old, among the last 8 events.
  int within(std::int64_t span_ns, std::int64_t now_ns) const {
    int found = 0;
    const std::uint64_t known = std::min<std::uint64_t>(count.load(), kTimes);
    for (std::size_t i = 0; i < known; ++i) {
      const std::int64_t time_ns = times_ns[i].load();
      if (time_ns >= 0 && time_ns <= now_ns && now_ns - time_ns < span_ns) ++found;
    }
    return found;
  }
};

// Event counters. They still count events whose notes a flood of newer notes has displaced from the flight recorder.
inline constexpr std::size_t kCountedRoles = 8;  // in the order of kLockstepRoleNames, then gateway; the last is spare
struct Counters {
  std::array<RecentCount, kCountedRoles> restarts;  // restarts of each role by the supervisor
  RecentCount refusals;                             // notes of refused records, written or not
  std::atomic<std::uint64_t> notes_folded;          // repeated notes that were counted instead of written
  // Bit n: the sender of input lane n runs, or it has died and no sender has claimed an input lane since. A sender that
  // claims a lane clears the bits of dead senders. Commands such as `yars inject` neither set nor clear bits.
  std::atomic<std::uint64_t> input_sources;
  std::atomic<std::uint64_t> frames_failing;  // 1: radar-display could not write its last frame to a file
};

// Entry of the process table, which informs the user. Checks of the clock also use the heartbeat (session_state.cpp).
// Locks decide which process is present.
struct ProcessEntry {
  std::atomic<std::int64_t> heartbeat_ns;          // CLOCK_MONOTONIC
  std::atomic<std::int32_t> pid;                   // 0: free
  std::atomic<std::uint32_t> progress;             // radar-display: version (low 32 bits) of the displayed radar state
  std::array<std::atomic<std::uint64_t>, 3> name;  // 23 characters and a zero byte
};

// Plan and progress of a lockstep run. Each role waits until the preceding role of the run has done the tick. The order
// of the roles is that of LockstepRole and kLockstepRoleNames.
enum class LockstepRole : std::uint8_t {
  flight_model,
  input_monitor,
  state_machine,
  radar_model,
  radar_display,
  recorder
};
inline constexpr std::size_t kLockstepRoles = 6;
inline constexpr std::array<std::string_view, kLockstepRoles> kLockstepRoleNames{
    "flight-model", "input-monitor", "state-machine", "radar-model", "radar-display", "recorder"};
// Bits of HostStatus::held_roles from here on: a process with the name kLockstepRoleNames[bit - kFirstProcessBit] takes
// part on the host. Lower bits are lock bytes of roles.
inline constexpr unsigned kFirstProcessBit = 24;
static_assert(kFirstProcessBit + kLockstepRoles <= 32);
struct Lockstep {
  std::atomic<std::uint32_t> enabled;                               // 1: lockstep; each role of the run sets it
  std::atomic<std::uint32_t> roles;                                 // bit n: role n takes part
  std::atomic<std::int64_t> end_tick;                               // all roles stop after this tick; -1: none
  std::array<std::atomic<std::int64_t>, kLockstepRoles> done_tick;  // last tick done; -1: none
  std::array<std::atomic<std::uint32_t>, kLockstepRoles> wake;      // futexes (Linux wait words); +1 with done_tick
};

// Ticks that a role skipped because it was late, in each of the last 16 seconds of CLOCK_MONOTONIC. One thread of the
// role's process writes.
struct SkippedTicks {
  static constexpr std::size_t kSeconds = 16;
  std::array<std::atomic<std::uint64_t>, kSeconds> seconds;  // high 32 bits: the second; low: ticks skipped in it

  void add(std::uint64_t ticks, std::int64_t now_ns) {
    const auto second = static_cast<std::uint64_t>(now_ns / 1'000'000'000) & 0xFFFF'FFFFU;
    auto& slot = seconds[second % kSeconds];
    const std::uint64_t before = slot.load(std::memory_order_relaxed);
    const std::uint64_t counted = before >> 32 == second ? before & 0xFFFF'FFFFU : 0;
    slot.store(second << 32 | std::min<std::uint64_t>(counted + ticks, 0xFFFF'FFFFU), std::memory_order_relaxed);
  }
  struct Sum {
    std::uint64_t ticks = 0;
    int seconds = 0;  // in which ticks were skipped
  };
  // Sum over the last `count` seconds, the present one included; `count` is at most kSeconds.
  Sum within(std::int64_t count, std::int64_t now_ns) const {
    Sum sum;
    const std::int64_t present = (now_ns / 1'000'000'000) & 0xFFFF'FFFF;
    for (const auto& slot : seconds) {
      const std::uint64_t value = slot.load(std::memory_order_relaxed);
      const std::int64_t age = present - static_cast<std::int64_t>(value >> 32);
      if (age < 0 || age >= count || (value & 0xFFFF'FFFFU) == 0) continue;
      sum.ticks += value & 0xFFFF'FFFFU;
      ++sum.seconds;
    }
    return sum;
  }
};

// Progress of records that a gateway copies from another host to a container of this segment. It outlives the gateway,
// so that the next gateway copies each record once.
struct RemoteProgress {
  std::atomic<std::uint64_t> source;  // hash of host, segment and container there; 0: none
  // High 32 bits: number of the next record of the source. 5 bits: lane of the container here. Low 27 bits: number of
  // records in it before the last one. Stored before a record is written. If that number has not changed since, the
  // last record is missing.
  std::atomic<std::uint64_t> progress;
};

// State of the gateway that joins this segment to the segments of other hosts (gateway/README.md).
struct Network {
  static constexpr std::size_t kHistories = 4, kHistorySources = 4, kInputSources = 32;
  std::atomic<std::uint64_t> segment;         // random number of this segment; 0: no gateway has joined it
  std::atomic<std::uint32_t> yielding_roles;  // bit n: role n is held on another host; its holder here must release it
  std::atomic<std::uint32_t> mirrored_roles;  // bit n: the gateway holds role n for another host
  std::atomic<std::uint32_t>
      wanted_roles;  // bit n: a process here wants role n, which the gateway holds for another host
  // Role of a lockstep run whose host has been gone for 10 s. Low 8 bits: 1 + index in kLockstepRoleNames; 0: none.
  // Next 8 bits: index of the host in NetworkStatus::hosts; 0: unknown. Written by the gateway.
  std::atomic<std::uint32_t> lost_role;
  std::array<RemoteProgress, kInputSources> input;  // of the last input lanes of other hosts
  // Of the rings applied_events, traffic_latched, model_ticks and sweeps, for the last hosts that wrote them.
  std::array<std::array<RemoteProgress, kHistorySources>, kHistories> histories;
  // Number of records in each of these rings up to the last one that came from another host.
  std::array<std::atomic<std::uint64_t>, kHistories> last_remote;
};

// Answer of radar-model's host to a requested change of the world.
enum class WorldAnswer : std::uint8_t {
  none,
  applied,
  outdated,   // based on an older edit than the newest one there
  refused,    // invalid there, or the session there is the replay of a recording
  late,       // it took longer than 1 s
  forbidden,  // this host may not write the topic world_requests
};

// Requests of this host to radar-model's host, while that is another one. The requested world lies in world_request.
struct alignas(shm::kCacheLine) WorldRequests {
  static constexpr std::uint64_t kLastNumber = ~std::uint64_t{0} >> 8;
  std::atomic<std::uint64_t> asked;  // number of the last request; written by the holder of the byte instructor
  // Number of the last answered request. Low 8 bits: WorldAnswer. Written by the gateway.
  std::atomic<std::uint64_t> answered;
  RemoteProgress latched;  // of the ring world_latched, for the host whose records it has
};

// Slot of a patch map. The writer clears the id, writes, and stores the new id last. A reader copies between two loads
// of the same id. progress_permille of a written slot is always 1000.
struct PatchSlot {
  std::atomic<std::uint64_t> id;  // 0: empty, or being written
  std::atomic<std::uint32_t> epoch;
  std::atomic<std::uint32_t> progress_permille;
  std::array<std::atomic<std::uint64_t>, sizeof(PatchMap) / 8> map;                      // words of a PatchMap
  std::array<std::atomic<std::uint64_t>, kMaxPatchPixels * kMaxPatchPixels / 8> pixels;  // rows without padding
};

// Slot of a display frame, for other programs; same protocol as PatchSlot.
struct FrameSlot {
  std::atomic<std::uint64_t> id;                                         // 0: empty, or being written
  std::array<std::atomic<std::uint64_t>, sizeof(GlassFrame) / 8> frame;  // words of a GlassFrame
  std::array<std::atomic<std::uint64_t>, kMaxFramePixels * kMaxFramePixels * 4 / 8> pixels;  // RGBA
};

// [bytes] Size of consecutive members of these types, from an aligned begin.
template <class... Members>
constexpr std::size_t size_of_members() {
  std::size_t size = 0;
  ((size = (size + alignof(Members) - 1) / alignof(Members) * alignof(Members) + sizeof(Members)), ...);
  return size;
}

}  // namespace yars::databuffer
