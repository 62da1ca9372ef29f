#include "tools/process_load.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include "databuffer/session.hpp"

namespace yars::tools {

namespace {

constexpr std::chrono::milliseconds kWindow{100};

// [ns] that all threads of a process have run; none when the system does not tell.
std::optional<std::uint64_t> run_time_ns(int pid) {
  std::error_code error;
  std::filesystem::directory_iterator threads("/proc/" + std::to_string(pid) + "/task", error);
  if (error) return std::nullopt;
  std::uint64_t total_ns = 0;
  bool told = false;
  for (const std::filesystem::directory_iterator end; !error && threads != end; threads.increment(error)) {
    std::ifstream file(threads->path() / "schedstat");
    std::uint64_t run_ns = 0;
    if (!(file >> run_ns)) continue;
    total_ns += run_ns;
    told = true;
  }
  return told ? std::optional(total_ns) : std::nullopt;
}

}  // namespace

std::map<int, double> measure_loads(const std::vector<int>& pids) {
  std::map<int, std::uint64_t> before;
  const std::int64_t began_ns = databuffer::monotonic_ns();
  for (const int pid : pids)
    if (const auto run_ns = run_time_ns(pid)) before[pid] = *run_ns;
  std::this_thread::sleep_for(kWindow);
  const auto elapsed_ns = static_cast<double>(databuffer::monotonic_ns() - began_ns);
  std::map<int, double> loads;
  for (const auto& [pid, before_ns] : before)
    // A thread that has ended takes its time along.
    if (const auto run_ns = run_time_ns(pid); run_ns && *run_ns >= before_ns)
      loads[pid] = static_cast<double>(*run_ns - before_ns) / elapsed_ns;
  return loads;
}

}  // namespace yars::tools
