#include "runtime/processor_load.hpp"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include "databuffer/session/session_state.hpp"

namespace yars::runtime {

namespace {

// Total processor time [ns] of the present threads of a process; nullopt if it cannot be read.
std::optional<std::uint64_t> run_time_ns(int pid) {
  std::error_code error;
  std::filesystem::directory_iterator threads("/proc/" + std::to_string(pid) + "/task", error);
  if (error) return std::nullopt;
  std::uint64_t total_ns = 0;
  bool has_value = false;
  for (const std::filesystem::directory_iterator end; !error && threads != end; threads.increment(error)) {
    std::ifstream file(threads->path() / "schedstat");
    std::uint64_t run_ns = 0;
    if (!(file >> run_ns)) continue;
    total_ns += run_ns;
    has_value = true;
  }
  return has_value ? std::optional(total_ns) : std::nullopt;
}

}  // namespace

std::map<int, double> LoadMeter::loads(const std::vector<int>& pids) {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  const auto elapsed_ns = static_cast<double>(now_ns - looked_ns_);
  std::map<int, std::uint64_t> found;
  std::map<int, double> loads;
  for (const int pid : pids) {
    const auto run_ns = run_time_ns(pid);
    if (!run_ns) continue;
    found[pid] = *run_ns;
    // Only present threads count. If their time has decreased, a thread has ended, and the load is unknown.
    const auto before = before_.find(pid);
    if (before != before_.end() && *run_ns >= before->second && elapsed_ns > 0.0)
      loads[pid] = static_cast<double>(*run_ns - before->second) / elapsed_ns;
  }
  before_ = std::move(found);
  looked_ns_ = now_ns;
  return loads;
}

}  // namespace yars::runtime
