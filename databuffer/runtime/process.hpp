// Process of a role: terminal made safe, signals, private files, CPUs, real-time priority, locked memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::databuffer {

// Standard output and standard error without control characters: what a file, a packet or an argument has in it cannot
// drive the terminal of whoever reads it, nor a log of what was printed. From here on all that this process prints, by
// stdio or iostream, goes through text::printable_lines. Call it first in main; a second call does nothing.
void guard_terminal();

// Logs, frames and recordings are the user's alone, whatever the umask: new files get 0600, new folders 0700.
void keep_files_private();

// From here on SIGINT and SIGTERM ask the process to stop.
void install_signal_handlers();
// For a command that never looks at stop_requested(): SIGINT and SIGTERM end it at once again.
void let_signals_end_the_process();

// True after SIGINT, SIGTERM or request_stop().
bool stop_requested();
void request_stop();

// What a role may ask of the system to be on time: memory that is not paged out, a real-time priority for the thread
// that ticks, CPUs of its own. Each may be refused; the program then says what and which limit to raise, and goes on
// without. A thread that computes kLongestBurst_ms without a pause steps back to normal priority by itself, before it
// can hold a CPU against the rest of the machine.
inline constexpr int kRealtimePriority = 20;  // of 1..99: above other programs, below the kernel's interrupt threads
inline constexpr int kLongestBurst_ms = 500;  // [ms] of CPU without a wait at real-time priority

// "2,3,6-7" -> 2 3 6 7, each once and in order; an error for anything else.
error::Expected<std::vector<int>> parse_cpu_list(std::string_view text);

// From the calling thread, before others are started: those are bound to the same CPUs, at normal priority.
// Each returns the reason and the remedy when it was refused.
std::optional<std::string> bind_to_cpus(const std::vector<int>& cpus);
std::optional<std::string> lock_memory();
std::optional<std::string> take_realtime_priority();

}  // namespace yars::databuffer
