// Processor load of processes between two looks. 1.0 is one fully used core.
// Inputs: pids; /proc/PID/task/TID/schedstat. Outputs: the load by pid.
// Errors: processes whose load cannot be measured are left out.
// Threads: one for each LoadMeter.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace yars::runtime {

class LoadMeter {
 public:
  // Load since the call before, of the processes that both calls name. The first call gives none.
  std::map<int, double> loads(const std::vector<int>& pids);

 private:
  std::map<int, std::uint64_t> before_;  // processor time [ns] by pid
  std::int64_t looked_ns_ = 0;           // CLOCK_MONOTONIC
};

}  // namespace yars::runtime
