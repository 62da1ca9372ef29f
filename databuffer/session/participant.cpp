#include "databuffer/session/participant.hpp"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

namespace yars::databuffer {

namespace {

using error::Expected;
using error::fail;

// Program name of a process, read from /proc.
std::string program_of(std::int32_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/comm");
  std::string name;
  std::getline(file, name);
  return name.empty() ? "unknown program" : name;
}

constexpr std::size_t kMaxNameLength = 40;
bool name_is_valid(std::string_view name) {
  const auto allowed = [](char letter) {
    return (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') ||
           letter == '_' || letter == '-';
  };
  return !name.empty() && !name.starts_with('-') && name.size() <= kMaxNameLength &&
         std::all_of(name.begin(), name.end(), allowed);
}

}  // namespace

Expected<void> check_session_name(const std::string& name) {
  if (name_is_valid(name)) return {};
  return tl::unexpected(error::Error{"session name", "1 to 40 letters, digits, '-' or '_', and no '-' at the front",
                                     "\"" + name + "\"", "choose another --session", error::ErrorCode::argument});
}

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
    case Role::tour:
      return "tour";
    case Role::gateway:
      return "gateway";
    case Role::instructor:
      return "instructor";
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
  // A time before the base counts as the base.
  const std::int64_t elapsed = std::max<std::int64_t>(monotonic_ns - clock.base_monotonic_ns, 0);
  // Rate 1 needs no double. After 104 days, the nanoseconds exceed the 53 significant bits of a double.
  if (clock.rate == 1.0) return clock.base_sim_ns + elapsed;
  return clock.base_sim_ns + static_cast<std::int64_t>(std::llround(clock.rate * static_cast<double>(elapsed)));
}

Claim::Claim() = default;
Claim::Claim(Claim&& other) noexcept : hold_(std::move(other.hold_)), lane_(std::exchange(other.lane_, -1)) {}
Claim& Claim::operator=(Claim&& other) noexcept {
  hold_ = std::move(other.hold_);
  lane_ = std::exchange(other.lane_, -1);
  return *this;
}
Claim::~Claim() = default;

void Participant::enter_table() {
  for (std::size_t i = 0; i < kProcesses; ++i) {
    if (!segment->try_lock(kFirstProcessByte + i)) continue;
    table_byte = kFirstProcessByte + i;
    ProcessEntry& entry = write().processes[i];
    entry.heartbeat_ns = monotonic_ns();
    entry.progress = 0;
    restore_entry();
    return;
  }
}

// Rewrites name and process id in this process's table entry, because another process may have overwritten them.
// Session::processes() leaves out an entry with process id 0.
void Participant::restore_entry() {
  if (table_byte == 0) return;
  ProcessEntry& entry = write().processes[table_byte - kFirstProcessByte];
  shm::store_text(entry.name.data(), entry.name.size(), process_name);
  entry.pid.store(getpid(), std::memory_order_release);
}

void Participant::beat(std::int64_t monotonic) {
  if (table_byte == 0) return;
  write().processes[table_byte - kFirstProcessByte].heartbeat_ns.store(monotonic, std::memory_order_relaxed);
}

void Participant::leave_table() {
  if (table_byte == 0) return;
  write().processes[table_byte - kFirstProcessByte].pid = 0;
  segment->unlock(table_byte);
}

// Text such as "state-machine, pid 1234". The name is read from the process table, else from /proc.
std::string Participant::describe_holder(std::size_t byte) const {
  const std::int32_t pid = segment->holder_pid(byte);
  if (pid == 0) return "a process that is just starting or ending";
  // A gateway has an entry for each role that it keeps for other hosts, too. Locks decide who is the gateway.
  constexpr auto kGateway = static_cast<std::size_t>(Role::gateway);
  if (segment->is_locked(kGateway) && segment->holder_pid(kGateway) == pid)
    return "gateway, pid " + std::to_string(pid) + (byte == kGateway ? "" : ", for another host");
  std::string program = program_of(pid);
  for (const ProcessEntry& entry : read().processes)
    if (entry.pid == pid) program = shm::load_text(entry.name.data(), entry.name.size());
  return program + ", pid " + std::to_string(pid);
}

std::optional<Claim> Participant::take(std::size_t byte, int lane) {
  if (!segment->try_lock(byte)) return std::nullopt;
  Claim claim;
  claim.hold_ = std::make_unique<Claim::Hold>(segment, byte);
  claim.lane_ = lane;
  return claim;
}

std::int32_t Participant::holder_of(Role role) const {
  return is_held(role) ? segment->holder_pid(static_cast<std::size_t>(role)) : 0;
}

// True if the gateway holds this role, and it is a role that every host may fill at the same time.
bool Participant::is_lent_to_gateway(Role role) const {
  const bool is_shared = role == Role::traffic || role == Role::recorder || role == Role::tour;
  return is_shared && holder_of(role) != 0 && holder_of(role) == holder_of(Role::gateway);
}

// Asks the gateway for a role that it holds for another host.
std::optional<Claim> Participant::take_back(Role role) {
  constexpr int kAttempts = 200;  // 1 ms apart; the gateway looks every 5 ms
  const auto byte = static_cast<std::size_t>(role);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    write().network.wanted_roles.fetch_or(1U << static_cast<unsigned>(role));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (auto claim = take(byte, -1)) return claim;
  }
  return std::nullopt;
}

Expected<Claim> Participant::claim(Role role) {
  const auto byte = static_cast<std::size_t>(role);
  auto claim = take(byte, -1);
  if (!claim && is_lent_to_gateway(role)) claim = take_back(role);
  if (claim) return std::move(*claim);
  const bool is_elsewhere =
      role != Role::gateway && holder_of(role) != 0 && holder_of(role) == holder_of(Role::gateway);
  return fail(
      "role " + std::string(name_of(role)), "one process of this role in a session", "held by " + describe_holder(byte),
      is_elsewhere ? "end it there, or wait for it with --standby" : "end that process, or choose another --session");
}

Expected<Claim> Participant::claim_ownship_lane(std::uint32_t priority) {
  for (std::size_t lane = 0; lane < kOwnshipLanes; ++lane) {
    auto claim = take(kFirstOwnshipByte + lane, static_cast<int>(lane));
    if (!claim) continue;
    clear_ownship_lane(write(), lane);
    write().ownship_priority[lane].store(priority, std::memory_order_release);
    return std::move(*claim);
  }
  std::string holders;
  for (std::size_t lane = 0; lane < kOwnshipLanes; ++lane)
    holders += (lane == 0 ? "" : "; ") + describe_holder(kFirstOwnshipByte + lane);
  return fail("ownship lane", "a free one of " + std::to_string(kOwnshipLanes), "all taken: " + holders,
              "end one of these processes");
}

Expected<Claim> Participant::claim_input_lane(std::string_view source) {
  std::string found;
  for (std::size_t lane = 0; lane < kInputLanes; ++lane) {
    auto claim = take(kFirstInputByte + lane, static_cast<int>(lane));
    // The lane becomes free when the consumer has read the remaining events of the previous source.
    if (claim && write().input.empty(lane)) {
      write().input.set_source(lane, source);
      claim->hold_->feeds_input = mark_input_source(lane);
      return std::move(*claim);
    }
    found += (found.empty() ? "" : ", ") + write().input.source(lane) + (claim ? " (gone, unread events)" : "");
  }
  return fail("input lane", "a free one of " + std::to_string(kInputLanes), "all taken: " + found,
              "end one of these sources, or start the state-machine, which empties the lanes");
}

// Sets the bit of a lane that this process has locked, and clears the bits of sources that have died. On an orderly
// release, ~Hold clears the bit. Commands such as `yars inject` do not count as sources.
bool Participant::mark_input_source(std::size_t lane) {
  if (process_name.starts_with("yars ")) return false;
  auto& sources = write().counters.input_sources;
  sources.fetch_or(input_source_bit(lane));
  for (std::size_t other = 0; other < kInputLanes; ++other) {
    if ((sources.load() & input_source_bit(other)) == 0 || !segment->try_lock(kFirstInputByte + other)) continue;
    sources.fetch_and(~input_source_bit(other));
    segment->unlock(kFirstInputByte + other);
  }
  return true;
}

}  // namespace yars::databuffer
