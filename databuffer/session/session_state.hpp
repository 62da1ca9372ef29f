// What a Session and a Claim hold: the segment, the place in the process table, the clock as it was last believed. For
// session.cpp and session_state.cpp alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/session/session.hpp"
#include "lib/log/log.hpp"

namespace yars::databuffer {

inline constexpr int kClockAttempts = 200;  // of 1 ms: another `yars sim` holds the clock for far less

// [ns] between looks at the segment's name and at the entry in the process table: a role says it within 1 s
inline constexpr std::int64_t kLook_ns = 500'000'000;

// Sim time 0 from this moment on, at rate 1.
ClockState first_clock();

inline SessionLayout& layout_of(shm::Segment& segment) {
  return *static_cast<SessionLayout*>(segment.memory());
}

// What a departed writer left must not pass for fresh with a reader that sees it for the first time.
inline void empty_ownship_lane(SessionLayout& layout, std::size_t lane) {
  layout.ownship[lane].clear();
  layout.nav[lane].clear();
}

// A source that goes in order is not missed. Never below none, whatever others have written there.
inline void forget_input_source(SessionLayout& layout) {
  auto& sources = layout.counters.input_sources;
  if (std::uint64_t seen = sources.load(); seen > 0) sources.compare_exchange_strong(seen, seen - 1);
}

struct Claim::Hold {
  std::shared_ptr<shm::Segment> segment;
  std::size_t byte;
  bool feeds_input = false;  // and is counted among Counters::input_sources

  Hold(std::shared_ptr<shm::Segment> in, std::size_t locked) : segment(std::move(in)), byte(locked) {}
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    if (const auto lane = byte - kFirstOwnshipByte; lane < kOwnshipLanes) empty_ownship_lane(layout_of(*segment), lane);
    segment->unlock(byte);
    if (feeds_input) forget_input_source(layout_of(*segment));
  }
};

struct Session::State {
  State(shm::Segment opened, std::string_view process)
      : segment(std::make_shared<shm::Segment>(std::move(opened))), process_name(process), clock(read().clock) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    tell_left_out(monotonic_ns(), true);
    leave_table();
  }
  static std::array<RepeatFilter, kNoteKinds> filters();

  SessionLayout& write() { return layout_of(*segment); }
  const SessionLayout& read() const { return *static_cast<const SessionLayout*>(std::as_const(*segment).memory()); }

  bool find_clock();  // false: there is no good one, and good_clock begins at 0 in a new epoch
  std::optional<std::string> clock_problem() const;
  void enter_table();
  void leave_table();
  std::string describe_holder(std::size_t byte) const;
  std::optional<Claim> take(std::size_t byte, int lane);
  ClockState clock_now();
  void note(NoteKind kind, std::string_view text, std::string_view process);
  void write_note(NoteKind kind, std::string_view text, std::string_view process);
  void tell_left_out(std::int64_t now_ns, bool all);
  bool count_input_sources();  // false: this process is none
  void keep_entry();
  void look_for_name();

  std::shared_ptr<shm::Segment> segment;
  std::string process_name;
  std::size_t table_byte = 0;     // 0: not in the table
  std::int64_t next_look_ns = 0;  // CLOCK_MONOTONIC
  bool had_name = true;
  std::mutex notes_mutex;  // of this process's threads only
  std::array<RepeatFilter, kNoteKinds> note_filters = filters();
  std::mutex clock_mutex;  // of this process's threads only
  shm::LatestReader<ClockState> clock;
  ClockState good_clock{};  // the last one that is in range
};

}  // namespace yars::databuffer
