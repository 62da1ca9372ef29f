#include "runtime/process.hpp"

#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ext/stdio_sync_filebuf.h>
#include <iostream>
#include <string>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::runtime {

namespace {

// Output stream of sanitize_terminal_output().
struct PrintableOutput {
  int descriptor;
  std::string unfinished;  // first bytes of a UTF-8 character; the next write has its other bytes
  int problem;             // errno of the first failed write; 0: none. Nothing is written after a failed write.
};

// Returns errno of the failed write; 0: all was written.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0 ? ENOSPC : errno;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

ssize_t write_printable(void* cookie, const char* bytes, std::size_t size) {
  auto& output = *static_cast<PrintableOutput*>(cookie);
  const std::string text = std::exchange(output.unfinished, {}) + std::string(bytes, size);
  std::string_view whole = text;
  whole.remove_suffix(text::unfinished_bytes(text));
  output.unfinished = text.substr(whole.size());
  if (output.problem == 0) output.problem = write_all(output.descriptor, text::printable_lines(whole));
  return output.problem == 0 ? static_cast<ssize_t>(size) : 0;
}

// Opens a stream that writes to `output` through write_printable(). nullptr: out of memory; the caller then keeps the
// standard streams.
std::FILE* open_printable(PrintableOutput& output, int buffering) {
  cookie_io_functions_t functions{};
  functions.write = write_printable;
  std::FILE* stream = ::fopencookie(&output, "w", functions);
  if (stream != nullptr) std::setvbuf(stream, nullptr, buffering, BUFSIZ);
  return stream;
}

// The two PrintableOutput objects are never deleted, because output may follow while the process ends.
PrintableOutput& standard_output() {
  static auto* const output = new PrintableOutput{STDOUT_FILENO, {}, 0};
  return *output;
}
PrintableOutput& standard_error() {
  static auto* const output = new PrintableOutput{STDERR_FILENO, {}, 0};
  return *output;
}

}  // namespace

void sanitize_terminal_output() {
  static const bool done = [] {
    file::occupy_standard_descriptors();
    std::FILE* out = open_printable(standard_output(), ::isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF);
    std::FILE* error = open_printable(standard_error(), _IONBF);
    if (out == nullptr || error == nullptr) return false;
    stdout = out;
    stderr = error;
    static auto* const cout_buffer = new __gnu_cxx::stdio_sync_filebuf<char>(out);
    static auto* const cerr_buffer = new __gnu_cxx::stdio_sync_filebuf<char>(error);
    std::cout.rdbuf(cout_buffer);
    std::cerr.rdbuf(cerr_buffer);
    std::clog.rdbuf(cerr_buffer);
    return true;
  }();
  (void)done;
}

error::Expected<void> close_standard_output() {
  errno = 0;
  int problem = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    const int write_problem = standard_output().problem;
    problem = write_problem != 0 ? write_problem : errno;
    if (problem == 0) problem = EIO;
  } else if (::close(STDOUT_FILENO) != 0 && errno != EBADF) {
    problem = errno;
  }
  if (problem == 0 || problem == EPIPE) return {};
  return error::fail("standard output", "a file that can be written", std::strerror(problem),
                     file::write_advice(problem));
}

void set_private_umask() {
  umask(0077);
}

namespace {

volatile std::sig_atomic_t stop_flag = 0;
volatile std::sig_atomic_t ends_soon = 0;

constexpr itimerval kTimeToEnd{{0, 0}, {0, 900'000}};  // 0.9 s

// Signal handlers with async-signal-safe calls only; setitimer is a system call.
void on_signal(int) {
  if (stop_flag == 0 && ends_soon != 0) setitimer(ITIMER_REAL, &kTimeToEnd, nullptr);
  stop_flag = 1;
}

void end_at_once(int) {
  constexpr char kText[] = "ended in the midst of its work, 0.9 s after the signal\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kText, sizeof kText - 1);
  _exit(0);
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action{};
  action.sa_handler = on_signal;  // no SA_RESTART: a sleep or poll returns at once
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void end_soon_after_signals() {
  std::signal(SIGALRM, end_at_once);
  ends_soon = 1;
}

void end_in_order() {
  ends_soon = 0;
  constexpr itimerval kNever{};
  setitimer(ITIMER_REAL, &kNever, nullptr);
}

void restore_default_signal_actions() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool stop_requested() {
  return stop_flag != 0;
}

void request_stop() {
  stop_flag = 1;
}

namespace {

constexpr std::string_view kLimitsFile = "/etc/security/limits.d or systemd (docs/operation.md)";
constexpr int kMaxCpu = CPU_SETSIZE - 1;

bool has_capability(unsigned capability) {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> data{};
  if (syscall(SYS_capget, &header, data.data()) != 0) return false;
  return (data[capability / 32].effective >> (capability % 32) & 1U) != 0;
}

std::string bytes_or_unlimited(rlim_t limit) {
  return limit == RLIM_INFINITY ? "unlimited" : std::to_string(limit);
}

// Signal handler with async-signal-safe calls only. getpid() names the first thread, which runs the tick loop.
void drop_to_normal_priority(int) {
  const sched_param normal{};
  sched_setscheduler(getpid(), SCHED_OTHER, &normal);
  constexpr char kText[] = "the tick loop used 0.5 s of CPU without a wait: normal priority from now on\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kText, sizeof kText - 1);
}

// Limits real-time computation: Linux sends SIGXCPU if a real-time thread computes for kMaxBurst_ms without a wait.
bool limit_bursts() {
  struct sigaction action{};
  action.sa_handler = drop_to_normal_priority;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  if (sigaction(SIGXCPU, &action, nullptr) != 0) return false;
  rlimit limit{};
  if (getrlimit(RLIMIT_RTTIME, &limit) != 0) return false;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, rlim_t{kMaxBurst_ms} * 1000);  // [us]
  return setrlimit(RLIMIT_RTTIME, &limit) == 0;
}

error::Expected<int> parse_cpu(std::string_view text) {
  const auto number = text::whole_number<int>(text);
  if (!number || *number < 0 || *number > kMaxCpu)
    return tl::unexpected(error::usage_error("--cpus", "numbers and ranges from 0, as in 2,3 or 2-3",
                                             std::string("'").append(text).append("'")));
  return *number;
}

}  // namespace

error::Expected<std::vector<int>> parse_cpu_list(std::string_view text) {
  std::vector<int> cpus;
  for (bool more = true; more;) {
    const auto comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    const auto dash = part.find('-');
    const auto first = parse_cpu(part.substr(0, dash));
    if (!first) return tl::unexpected(first.error());
    const auto last = dash == std::string_view::npos ? first : parse_cpu(part.substr(dash + 1));
    if (!last) return tl::unexpected(last.error());
    if (*last < *first)
      return tl::unexpected(error::usage_error("--cpus", "a range from low to high", std::string(part)));
    for (int cpu = *first; cpu <= *last; ++cpu) cpus.push_back(cpu);
    more = comma != std::string_view::npos;
    if (more) text.remove_prefix(comma + 1);
  }
  std::sort(cpus.begin(), cpus.end());
  cpus.erase(std::unique(cpus.begin(), cpus.end()), cpus.end());
  return cpus;
}

std::optional<std::string> bind_to_cpus(const std::vector<int>& cpus) {
  cpu_set_t allowed;
  cpu_set_t wanted;
  CPU_ZERO(&allowed);
  CPU_ZERO(&wanted);
  sched_getaffinity(0, sizeof allowed, &allowed);
  std::string absent;
  for (const int cpu : cpus) {
    CPU_SET(static_cast<std::size_t>(cpu), &wanted);
    if (!CPU_ISSET(static_cast<std::size_t>(cpu), &allowed))
      absent.append(absent.empty() ? "" : ",").append(std::to_string(cpu));
  }
  if (!absent.empty())
    return "--cpus: CPU " + absent + " is not available to this program (see taskset -p $$); all allowed CPUs are used";
  if (sched_setaffinity(0, sizeof wanted, &wanted) == 0) return std::nullopt;
  return std::string("--cpus: refused: ") + std::strerror(errno) + "; all CPUs are used";
}

// Locks no memory if RLIMIT_MEMLOCK (maximum of locked memory) is finite and the process lacks the privilege
// CAP_IPC_LOCK, which lifts this limit. Otherwise a later allocation beyond the limit would fail.
std::optional<std::string> lock_memory() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur != RLIM_INFINITY && !has_capability(CAP_IPC_LOCK))
    return "--realtime: memory is not locked: expected RLIMIT_MEMLOCK unlimited, found " +
           bytes_or_unlimited(limit.rlim_cur) + " bytes; raise memlock in " + std::string(kLimitsFile);
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return std::nullopt;
  return std::string("--realtime: memory is not locked: ") + std::strerror(errno) + "; raise memlock in " +
         std::string(kLimitsFile);
}

std::optional<std::string> take_realtime_priority() {
  if (!limit_bursts())
    return std::string("--realtime: normal priority: expected to limit bursts by RLIMIT_RTTIME, found ") +
           std::strerror(errno);
  // RESET_ON_FORK: later threads run at normal priority. Only the thread of the tick loop needs real-time priority.
  sched_param priority{};
  priority.sched_priority = kRealtimePriority;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &priority) == 0) return std::nullopt;
  const int error = errno;
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  return "--realtime: normal priority: expected permission to use SCHED_FIFO " + std::to_string(kRealtimePriority) +
         ", found " + std::strerror(error) + " with RLIMIT_RTPRIO " + bytes_or_unlimited(limit.rlim_cur) +
         "; raise rtprio in " + std::string(kLimitsFile);
}

}  // namespace yars::runtime
