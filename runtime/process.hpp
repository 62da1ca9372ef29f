// Operating system services for a program: terminal output, signals, umask, CPUs, real-time priority, locked memory.
// Inputs: --cpus and --realtime.
// Errors: bind_to_cpus, lock_memory and take_realtime_priority return a refusal by the system as text; the program then
// continues without that service.
// Threads: call from the first thread before it starts other threads. These inherit its CPUs, not its priority.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::runtime {

// Routes standard output and standard error through text::printable_lines, which escapes control characters. Text from
// a file, packet or argument then cannot control the reader's terminal. Applies to stdio and iostream. Call it first in
// main; a second call does nothing.
void sanitize_terminal_output();

// Flushes and closes standard output. Error: this write or an earlier write has failed. A closed pipe is no error, nor
// is a descriptor that was closed before the start if nothing was written. Call it once, at the end of main.
error::Expected<void> close_standard_output();

// Sets the umask so that new files have mode 0600 and new folders 0700. Other users cannot read logs, frames and
// recordings.
void set_private_umask();

// After this call, SIGINT and SIGTERM set the flag of stop_requested().
void install_signal_handlers();
// For roles and services: 0.9 s after SIGINT or SIGTERM the process ends with code 0, whatever it computes, waits for
// or reads. A session survives the death of any of its processes at any moment. Call it after
// install_signal_handlers(). A timer of ITIMER_REAL and SIGALRM are then in use.
void end_soon_after_signals();
// For services, which have something to end: the signal was noticed, and the process ends by itself.
void end_in_order();
// Restores the default action of SIGINT and SIGTERM, for a command that never reads stop_requested().
void restore_default_signal_actions();

// True after SIGINT, SIGTERM or request_stop().
bool stop_requested();
void request_stop();

// Real-time services. The system may refuse each; the program then logs a warning and continues.
// If the first thread computes for kMaxBurst_ms without a wait, it returns to normal priority. A real-time thread
// without waits could block a CPU.

// SCHED_FIFO priority, 1..99: above all threads of normal priority, below Linux interrupt threads (50). A higher
// priority than 50 would delay interrupts.
inline constexpr int kRealtimePriority = 20;
inline constexpr int kMaxBurst_ms = 500;  // [ms] maximum CPU time of a real-time thread without a wait

// Parses a CPU list: "2,3,6-7" gives 2 3 6 7, sorted and without duplicates. A malformed list is a usage error.
error::Expected<std::vector<int>> parse_cpu_list(std::string_view text);

// Each function returns the reason if the system refuses, with a remedy where there is one; else nullopt.
std::optional<std::string> bind_to_cpus(const std::vector<int>& cpus);
std::optional<std::string> lock_memory();
std::optional<std::string> take_realtime_priority();

}  // namespace yars::runtime
