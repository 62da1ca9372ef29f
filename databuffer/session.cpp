#include "databuffer/session.hpp"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "databuffer/layout_identity.hpp"
#include "databuffer/log.hpp"
#include "databuffer/records/validation.hpp"
#include "lib/failure/require.hpp"

namespace yars::databuffer {

namespace {

using failure::Expected;
using failure::fail;

constexpr std::size_t kLongestName = 40;
constexpr std::int64_t kNameLook_ns =
    500'000'000;                     // [ns] between looks at the segment's name: a role says it within 1 s
constexpr int kClockAttempts = 200;  // of 1 ms: another `yars sim` holds the clock for far less
// [ns] 14 years: a base beyond it is no time that a session has come to, and sums with it at rate 10 would not fit.
constexpr std::int64_t kLatestBase_ns = std::int64_t{1} << 59;

bool name_is_valid(std::string_view name) {
  const auto allowed = [](char letter) {
    return (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') ||
           letter == '_' || letter == '-';
  };
  return !name.empty() && name.size() <= kLongestName && std::all_of(name.begin(), name.end(), allowed);
}

Expected<void> check_name(const std::string& name) {
  if (name_is_valid(name)) return {};
  return tl::unexpected(failure::Error{"session name", "1 to 40 letters, digits, '-' or '_'", "\"" + name + "\"",
                                       "choose another --session", true});
}

void initialize(void* memory) {
  auto& layout = *static_cast<SessionLayout*>(memory);
  layout.lockstep.end_tick = -1;
  for (auto& done : layout.lockstep.done_tick) done = -1;
  ClockState clock{};
  clock.base_monotonic_ns = monotonic_ns();
  clock.rate = 1.0;
  clock.running = 1;
  clock.reposition_latitude_deg = clock.reposition_longitude_deg = std::numeric_limits<double>::quiet_NaN();
  clock.reposition_altitude_m = clock.reposition_heading_deg = std::numeric_limits<double>::quiet_NaN();
  layout.clock.publish(clock);
}

tl::unexpected<failure::Error> fail_read_only(std::string_view subject) {
  return fail(std::string(subject), "a session opened for writing", "one opened read-only", "open it for writing");
}

// The system's name of a process; for one that is not in the table.
std::string program_of(std::int32_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/comm");
  std::string name;
  std::getline(file, name);
  return name.empty() ? "unknown program" : name;
}

SessionLayout& layout_of(shm::Segment& segment) {
  return *static_cast<SessionLayout*>(segment.memory());
}

// The clock as every process of the session may take it for granted; `found` says why not.
Expected<void> check_clock(const ClockState& clock) {
  Refusal refusal = why_refused(clock);
  if (!refusal && std::max(clock.base_sim_ns, clock.base_monotonic_ns) > kLatestBase_ns)
    refusal = "base_sim_ns, base_monotonic_ns: expected at most 2^59, found more";
  if (!refusal) return {};
  return fail("session clock", "one in range", *refusal, "set it with `yars sim reset 0`, or start the set again");
}

// What a departed writer left must not pass for fresh with a reader that sees it for the first time.
void empty_ownship_lane(SessionLayout& layout, std::size_t lane) {
  layout.ownship[lane].clear();
  layout.nav[lane].clear();
}

template <std::size_t N>
void copy_text(char (&into)[N], std::string_view text) {
  into[text.copy(into, N - 1)] = '\0';
}

}  // namespace

std::string_view name_of(Role role) {
  switch (role) {
    case Role::radar_model:
      return "radar-model";
    case Role::state_machine:
      return "state-machine";
    case Role::recorder:
      return "recorder";
    case Role::clock:
      return "clock";
    case Role::traffic:
      return "traffic";
    case Role::glass_frames:
      return "glass frames";
  }
  return "unknown role";
}

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

std::int64_t sim_time_at(const ClockState& clock, std::int64_t monotonic_ns) {
  if (clock.running == 0) return clock.base_sim_ns;
  // A base yet to come has nothing elapsed: sim time never is before it.
  const std::int64_t elapsed = std::max<std::int64_t>(monotonic_ns - clock.base_monotonic_ns, 0);
  // At rate 1 no rounding: integer nanoseconds outlast the 53 bits of a double.
  if (clock.rate == 1.0) return clock.base_sim_ns + elapsed;
  return clock.base_sim_ns + static_cast<std::int64_t>(std::llround(clock.rate * static_cast<double>(elapsed)));
}

// ---- Claims ----

struct Claim::Hold {
  std::shared_ptr<shm::Segment> segment;
  std::size_t byte;

  Hold(std::shared_ptr<shm::Segment> in, std::size_t locked) : segment(std::move(in)), byte(locked) {}
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    if (const auto lane = byte - kFirstOwnshipByte; lane < kOwnshipLanes) empty_ownship_lane(layout_of(*segment), lane);
    segment->unlock(byte);
  }
};

Claim::Claim() = default;
Claim::Claim(Claim&& other) noexcept : hold_(std::move(other.hold_)), lane_(std::exchange(other.lane_, -1)) {}
Claim& Claim::operator=(Claim&& other) noexcept {
  hold_ = std::move(other.hold_);
  lane_ = std::exchange(other.lane_, -1);
  return *this;
}
Claim::~Claim() = default;

// ---- The session ----

struct Session::State {
  State(shm::Segment opened, std::string_view process)
      : segment(std::make_shared<shm::Segment>(std::move(opened))), process_name(process), clock(read().clock) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { leave_table(); }

  SessionLayout& write() { return layout_of(*segment); }
  const SessionLayout& read() const { return *static_cast<const SessionLayout*>(std::as_const(*segment).memory()); }

  Expected<void> find_clock();
  void enter_table();
  void leave_table();
  std::string describe_holder(std::size_t byte) const;
  std::optional<Claim> take(std::size_t byte, int lane);
  ClockState clock_now();
  void note(NoteKind kind, std::string_view text, std::string_view process);
  void look_for_name(std::int64_t now_ns);

  std::shared_ptr<shm::Segment> segment;
  std::string process_name;
  std::size_t table_byte = 0;          // 0: not in the table
  std::int64_t next_name_look_ns = 0;  // CLOCK_MONOTONIC
  bool had_name = true;
  std::mutex clock_mutex;  // of this process's threads only
  shm::LatestReader<ClockState> clock;
  ClockState good_clock{};  // the last one that is in range
};

// Published before the segment had a name, and changed seldom: as a rule the first look finds it.
Expected<void> Session::State::find_clock() {
  for (int attempt = 0; attempt < kClockAttempts && !clock.refresh(); ++attempt)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!clock.has_value())
    return fail("session clock", "one that can be read", "none", "end the programs of this session and start it again");
  if (auto good = check_clock(clock.value()); !good) return good;
  good_clock = clock.value();
  return {};
}

// A full table is no failure: it is for people, presence is decided by locks.
void Session::State::enter_table() {
  for (std::size_t i = 0; i < kProcesses; ++i) {
    if (!segment->try_lock(kFirstProcessByte + i)) continue;
    table_byte = kFirstProcessByte + i;
    ProcessEntry& entry = write().processes[i];
    shm::store_text(entry.name.data(), entry.name.size(), process_name);
    entry.heartbeat_ns = monotonic_ns();
    entry.progress = 0;
    entry.pid.store(getpid(), std::memory_order_release);
    return;
  }
}

void Session::State::leave_table() {
  if (table_byte == 0) return;
  write().processes[table_byte - kFirstProcessByte].pid = 0;
  segment->unlock(table_byte);
}

// "state-machine, pid 1234": by the table, else by the system.
std::string Session::State::describe_holder(std::size_t byte) const {
  const std::int32_t pid = segment->holder_pid(byte);
  if (pid == 0) return "a process that is just starting or ending";
  std::string program = program_of(pid);
  for (const ProcessEntry& entry : read().processes)
    if (entry.pid == pid) program = shm::load_text(entry.name.data(), entry.name.size());
  return program + ", pid " + std::to_string(pid);
}

std::optional<Claim> Session::State::take(std::size_t byte, int lane) {
  if (!segment->try_lock(byte)) return std::nullopt;
  Claim claim;
  claim.hold_ = std::make_unique<Claim::Hold>(segment, byte);
  claim.lane_ = lane;
  return claim;
}

// One out of range is refused, noted once, and the last good one goes on.
ClockState Session::State::clock_now() {
  std::unique_lock guard(clock_mutex);
  if (!clock.refresh()) return good_clock;
  const auto good = check_clock(clock.value());
  if (good) good_clock = clock.value();
  const ClockState now = good_clock;
  guard.unlock();
  if (!good) note(NoteKind::refusal, "clock: " + good.error().found, process_name);
  return now;
}

void Session::State::note(NoteKind kind, std::string_view text, std::string_view process) {
  if (!segment->writable()) return;
  Note line{};
  line.monotonic_ns = monotonic_ns();
  line.sim_time_ns = sim_time_at(clock_now(), line.monotonic_ns);
  line.pid = getpid();
  line.kind = static_cast<std::uint32_t>(kind);
  copy_text(line.process, process);
  copy_text(line.text, text);
  write().note_counts[line.kind].fetch_add(1, std::memory_order_relaxed);
  write().notes.append(line);
}

void Session::State::look_for_name(std::int64_t now_ns) {
  if (!had_name || now_ns < next_name_look_ns) return;
  next_name_look_ns = now_ns + kNameLook_ns;
  had_name = segment->has_name();
  if (had_name) return;
  note(NoteKind::supervision, "the segment's name was removed (RemoveIPC?); the set goes on without", process_name);
  log_error(
      "the segment's file in /dev/shm was removed by somebody else: as a rule by systemd-logind, whose RemoveIPC=yes "
      "does so when a user's last login ends. The set goes on, and what joins it finds it all the same; to keep the "
      "file: loginctl enable-linger, or RemoveIPC=no in /etc/systemd/logind.conf");
}

Session::Session(std::unique_ptr<State> state) : state_(std::move(state)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Expected<Session> Session::open(const std::string& name, std::string_view process_name) {
  if (const auto valid = check_name(name); !valid) return tl::unexpected(valid.error());
  auto segment = shm::Segment::open(name, kLayoutIdentity, initialize);
  if (!segment) return tl::unexpected(segment.error());
  auto state = std::make_unique<State>(std::move(*segment), process_name);
  if (const auto found = state->find_clock(); !found) return tl::unexpected(found.error());
  state->enter_table();
  return Session(std::move(state));
}

Expected<Session> Session::open_read_only(const std::string& name) {
  if (const auto valid = check_name(name); !valid) return tl::unexpected(valid.error());
  auto segment = shm::Segment::open_read_only(name, kLayoutIdentity);
  if (!segment) return tl::unexpected(segment.error());
  auto state = std::make_unique<State>(std::move(*segment), "reader");
  if (const auto found = state->find_clock(); !found) return tl::unexpected(found.error());
  return Session(std::move(state));
}

SessionLayout& Session::layout() {
  return state_->write();
}
const SessionLayout& Session::layout() const {
  return std::as_const(*state_).read();
}
bool Session::created() const {
  return state_->segment->created();
}
bool Session::has_name() const {
  return state_->segment->has_name();
}

Expected<Claim> Session::claim(Role role) {
  if (!state_->segment->writable()) return fail_read_only(name_of(role));
  const auto byte = static_cast<std::size_t>(role);
  const std::int32_t previous = state_->segment->holder_pid(byte);
  auto claim = state_->take(byte, -1);
  if (!claim)
    return fail("role " + std::string(name_of(role)), "one process of this role in a session",
                "held by " + state_->describe_holder(byte), "end that process, or choose another --session");
  // Whoever lets a role go in order leaves no pid behind.
  if (previous != 0)
    note(NoteKind::restart, std::string(name_of(role)) + " pid " + std::to_string(previous) + " died; taken over");
  return std::move(*claim);
}

Expected<Claim> Session::claim_ownship_lane(std::uint32_t priority) {
  if (!state_->segment->writable()) return fail_read_only("ownship lane");
  for (std::size_t lane = 0; lane < kOwnshipLanes; ++lane) {
    auto claim = state_->take(kFirstOwnshipByte + lane, static_cast<int>(lane));
    if (!claim) continue;
    empty_ownship_lane(layout(), lane);
    layout().ownship_priority[lane].store(priority, std::memory_order_release);
    return std::move(*claim);
  }
  std::string holders;
  for (std::size_t lane = 0; lane < kOwnshipLanes; ++lane)
    holders += (lane == 0 ? "" : "; ") + state_->describe_holder(kFirstOwnshipByte + lane);
  return fail("ownship lane", "a free one of " + std::to_string(kOwnshipLanes), "all taken: " + holders,
              "end one of these processes");
}

Expected<Claim> Session::claim_input_lane(std::string_view source) {
  if (!state_->segment->writable()) return fail_read_only("input lane");
  std::string found;
  for (std::size_t lane = 0; lane < kInputLanes; ++lane) {
    auto claim = state_->take(kFirstInputByte + lane, static_cast<int>(lane));
    // Events that a departed source left are still the consumer's: the lane is free when they are gone.
    if (claim && layout().input.empty(lane)) {
      layout().input.set_source(lane, source);
      return std::move(*claim);
    }
    found += (found.empty() ? "" : ", ") + layout().input.source(lane) + (claim ? " (gone, unread events)" : "");
  }
  return fail("input lane", "a free one of " + std::to_string(kInputLanes), "all taken: " + found,
              "end one of these sources, or start the state-machine, which empties the lanes");
}

bool Session::role_is_held(Role role) const {
  return state_->segment->is_locked(static_cast<std::size_t>(role));
}

std::int32_t Session::role_holder(Role role) const {
  return role_is_held(role) ? state_->segment->holder_pid(static_cast<std::size_t>(role)) : 0;
}
bool Session::ownship_lane_is_held(std::size_t lane) const {
  YARS_REQUIRE(lane, <, kOwnshipLanes);
  return state_->segment->is_locked(kFirstOwnshipByte + lane);
}
bool Session::input_lane_is_held(std::size_t lane) const {
  YARS_REQUIRE(lane, <, kInputLanes);
  return state_->segment->is_locked(kFirstInputByte + lane);
}

std::vector<ProcessHere> Session::processes() const {
  std::vector<ProcessHere> here;
  for (std::size_t i = 0; i < kProcesses; ++i) {
    const ProcessEntry& entry = layout().processes[i];
    if (entry.pid == 0 || !state_->segment->is_locked(kFirstProcessByte + i)) continue;
    // A beat yet to come would make who has hung seem alive.
    const std::int64_t beat_ns = std::clamp<std::int64_t>(entry.heartbeat_ns, 0, monotonic_ns());
    here.push_back({entry.pid, shm::load_text(entry.name.data(), entry.name.size()), beat_ns, entry.progress});
  }
  return here;
}

void Session::heartbeat() {
  if (state_->table_byte == 0) return;
  const std::int64_t now_ns = monotonic_ns();
  state_->write().processes[state_->table_byte - kFirstProcessByte].heartbeat_ns.store(now_ns,
                                                                                       std::memory_order_relaxed);
  state_->look_for_name(now_ns);
}

void Session::show_progress(std::uint32_t progress) {
  if (state_->table_byte == 0) return;
  state_->write().processes[state_->table_byte - kFirstProcessByte].progress.store(progress, std::memory_order_release);
}

ClockState Session::clock() const {
  return state_->clock_now();
}
std::int64_t Session::sim_time_ns() const {
  return sim_time_at(clock(), monotonic_ns());
}

Expected<void> Session::set_clock(const ClockState& state) {
  return change_clock([&state](const ClockState&) { return state; });
}

Expected<void> Session::change_clock(const std::function<ClockState(const ClockState&)>& change, Patience patience) {
  constexpr auto kByte = static_cast<std::size_t>(Role::clock);
  if (!state_->segment->writable()) return fail_read_only("clock");
  const int attempts = patience == Patience::none ? 1 : kClockAttempts;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (const auto claim = state_->take(kByte, -1)) {
      layout().clock.publish(change(state_->clock_now()));
      return {};
    }
    if (attempt + 1 < attempts) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return fail("clock", "to change it within " + std::to_string(attempts) + " ms",
              "held by " + state_->describe_holder(kByte), "let that process go on, or end it");
}

void Session::note(NoteKind kind, std::string_view text) {
  state_->note(kind, text, state_->process_name);
}
void Session::note(NoteKind kind, std::string_view text, std::string_view process) {
  state_->note(kind, text, process);
}

}  // namespace yars::databuffer
