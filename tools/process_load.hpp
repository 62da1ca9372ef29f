// What processes take of the CPU, as the kernel counts it.
#pragma once

#include <map>
#include <vector>

namespace yars::tools {

// Shares of a core (2.0 = two cores) over the next 0.1 s, by pid; a process that may not be looked at is left out.
std::map<int, double> measure_loads(const std::vector<int>& pids);

}  // namespace yars::tools
