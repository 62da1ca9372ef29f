// What a laboratory does to a set, one function a fault; issue by issue in docs/faults.md. A function does its
// damage, takes away again what it put there, and returns; what died is started again by StormSet::mend().
#pragma once

#include <string>
#include <vector>

namespace yars::endtoend::storm {

class StormSet;

struct Fault {
  std::string name;
  void (*happen)(StormSet& set, const std::string& role);
  std::string role = {};  // of those that befall one role
};

std::vector<Fault> process_faults();  // deaths, stops, clients that die while they write
std::vector<Fault> session_faults();  // memory, layouts, users, second sets, clocks
std::vector<Fault> file_faults();     // terrain, scenes, configurations, recordings
std::vector<Fault> input_faults();    // floods, hostile records
std::vector<Fault> packet_faults();   // hostile packets by UDP

std::vector<Fault> all_faults();

}  // namespace yars::endtoend::storm
