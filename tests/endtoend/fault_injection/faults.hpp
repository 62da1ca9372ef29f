// Faults of docs/faults.md, one function each. A function causes the fault, removes what it added, and returns.
// FaultSet::mend() then restarts what has died.
#pragma once

#include <string>
#include <vector>

namespace yars::endtoend::fault_injection {

class FaultSet;

struct Fault {
  std::string name;
  void (*happen)(FaultSet& set, const std::string& role);
  std::string role = {};  // second argument of `happen`: a role, a mode of fault_client or a kind of packets
};

std::vector<Fault> process_faults();  // deaths and stops of roles; clients that die while they write
std::vector<Fault> session_faults();  // memory, layouts, users, second sets, clocks
std::vector<Fault> file_faults();     // terrain, scenes, configurations, recordings
std::vector<Fault> input_faults();    // floods, hostile records
std::vector<Fault> packet_faults();   // hostile packets by UDP

std::vector<Fault> all_faults();

}  // namespace yars::endtoend::fault_injection
