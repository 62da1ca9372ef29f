// Timing for benchmarks: thread CPU time, and the median of several rounds. timed() repeats a disturbed measurement:
// one in which the hypervisor gave more than 2 % of the processor time to other machines.
#pragma once

#include <time.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace yars::benchmarks {

inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Time of all processors together in jiffies, from the first line of /proc/stat. `stolen` is the part that the
// hypervisor gave to other machines.
struct Processors {
  double all = 0.0, stolen = 0.0;
};
inline Processors processors() {
  std::ifstream file("/proc/stat");
  std::string word;
  file >> word;
  Processors result;
  double value = 0.0;
  constexpr int kStealField = 7;
  for (int field = 0; field <= kStealField && file >> value; ++field) {
    result.all += value;
    if (field == kStealField) result.stolen = value;
  }
  return result;
}

// Thread CPU time of the work [s]. After kMaxRepeats disturbed measurements the last one counts.
template <class Work>
double timed(const Work& work) {
  constexpr int kMaxRepeats = 10;
  constexpr double kMaxSteal = 0.02;
  double seconds = 0.0;
  for (int attempt = 0; attempt < kMaxRepeats; ++attempt) {
    const Processors before = processors();
    const double begin_s = thread_seconds();
    work();
    seconds = thread_seconds() - begin_s;
    const Processors after = processors();
    if (after.stolen - before.stolen <= kMaxSteal * (after.all - before.all)) break;
  }
  return seconds;
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace yars::benchmarks
