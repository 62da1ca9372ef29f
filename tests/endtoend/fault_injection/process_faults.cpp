// Faults of processes: deaths and stops of roles, and of external programs while they write.
#include <signal.h>

#include <algorithm>

#include "tests/endtoend/fault_injection/fault_set.hpp"
#include "tests/endtoend/fault_injection/faults.hpp"

namespace yars::endtoend::fault_injection {

namespace {

void kill_role(FaultSet& set, const std::string& role) {
  set.kill(role);
}

void kill_several(FaultSet& set, const std::string&) {
  auto roles = kRoles;
  std::shuffle(roles.begin(), roles.end(), set.chance());
  roles.resize(2 + set.below(3));
  for (const auto& role : roles) set.kill(role);
}

// No program is left. The next one that starts makes a new segment.
void kill_all(FaultSet& set, const std::string&) {
  for (const auto& role : kRoles) set.kill(role);
}

void stop_role(FaultSet& set, const std::string& role) {
  set.processes().kill(role, SIGSTOP);
  set.rest_ms(20.0, 900.0);
  set.processes().kill(role, SIGCONT);
}

// Kills a client eight times while it writes without pause.
void kill_writers(FaultSet& set, const std::string& mode) {
  constexpr int kKills = 8;
  for (int i = 0; i < kKills; ++i) {
    const auto client = set.client(mode, 0.0);
    set.rest_ms(4.0, 30.0);
    set.end_client(client);
  }
}

void kill_frame_writers(FaultSet& set, const std::string&) {
  set.kill("radar-display");
  kill_writers(set, "frames");
}

void die_with_a_lane(FaultSet& set, const std::string&) {
  const auto client = set.client("die-with-lane", 0.0);
  if (const int code = set.processes().wait(client); code != 128 + SIGKILL && code != 1)
    set.tell("a client that kills itself ended with code " + std::to_string(code));
}

}  // namespace

std::vector<Fault> process_faults() {
  std::vector<Fault> faults;
  for (const auto& role : kRoles) faults.push_back({"kill -9 " + role, kill_role, role});
  for (const auto& role : kRoles) faults.push_back({"SIGSTOP, SIGCONT " + role, stop_role, role});
  faults.push_back({"kill -9 several roles at once", kill_several});
  faults.push_back({"kill -9 the whole set", kill_all});
  faults.push_back({"kill -9 an ownship writer in the midst, 8 times", kill_writers, "fly"});
  faults.push_back({"kill -9 an event pusher in the midst, 8 times", kill_writers, "push"});
  faults.push_back({"kill -9 a clock setter in the midst, 8 times", kill_writers, "clock"});
  faults.push_back({"kill -9 a picture publisher in the midst, 8 times", kill_frame_writers});
  faults.push_back({"an owner claims a lane and dies", die_with_a_lane});
  return faults;
}

std::vector<Fault> all_faults() {
  std::vector<Fault> all;
  for (const auto& part : {process_faults(), session_faults(), file_faults(), input_faults(), packet_faults()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace yars::endtoend::fault_injection
