// Log of a program: lines on standard error and in a rotated file, with a rate limit for repeated lines.
// Inputs: text of one line, by one function for each level: debug(), info(), warning(), error().
// Outputs: standard error and, after start_file(), FOLDER/PROGRAM.log. Control characters are escaped.
// Errors: a log file that cannot be written is reported once on standard error.
// Threads: writing lines is thread-safe. start() and start_file() must be called before the first line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace yars::log {

// Rate limiter for log lines. In each window of 10 s it passes the first lines of each kind; it suppresses and counts
// the others. Two lines are of one kind if they are equal apart from digits and the text after ", found". A kind with
// suppressed lines gets its next window only after take_suppressed() has returned these lines.
class RepeatFilter {
 public:
  static constexpr std::int64_t kWindow_ns = 10'000'000'000;  // [ns] length of a window, from a kind's first line on
  static constexpr std::size_t kMaxKinds = 64;                // a 64th kind evicts the oldest kind

  // Maximum number of lines that pass within a window, for one kind and for all kinds together.
  RepeatFilter(int max_per_kind, int max_total) : max_per_kind_(max_per_kind), max_total_(max_total) {}

  // True if the line passes; otherwise it is suppressed and counted. `now_ns`: CLOCK_MONOTONIC [ns].
  bool passes(std::string_view line, std::int64_t now_ns);

  // Suppressed lines of one kind.
  struct SuppressedLines {
    std::string line;     // the newest suppressed line
    std::uint64_t count;  // number of suppressed lines
    std::string text() const { return line + " (and " + std::to_string(count - 1) + " more suppressed)"; }
  };
  // Returns the suppressed lines of each kind whose window has ended, and removes the kind. With `all`, every window
  // counts as ended. All evicted kinds together are returned as one kind.
  std::vector<SuppressedLines> take_suppressed(std::int64_t now_ns, bool all = false);

 private:
  struct Kind {
    std::string key;        // result of key_of(), equal for all lines of the kind
    std::int64_t begin_ns;  // [ns] start of the kind's window
    int passed;             // lines passed in the window
    SuppressedLines suppressed;
  };
  Kind& kind_of(std::string_view line, std::int64_t now_ns);
  void evict_oldest();

  int max_per_kind_, max_total_;
  std::vector<Kind> kinds_;           // oldest first
  Kind evicted_{};                    // suppressed lines of evicted kinds
  std::int64_t window_begin_ns_ = 0;  // [ns] start of the window for the limit on all kinds
  int passed_in_window_ = 0;          // lines of all kinds in that window
};

// The functions below use the library spdlog. Only log.cpp includes the headers of spdlog.
inline constexpr std::size_t kLogFileBytes = std::size_t{4} << 20;  // [bytes] a larger file is rotated
inline constexpr std::size_t kOldLogFiles = 3;  // number of rotated files kept; the newest of them is PROGRAM.1.log

// Starts the log on standard error. Levels: trace, debug, info, warning, error, off. False: `level` is none of these.
bool start(const std::string& program, const std::string& level);
// After start(): also writes the log to `folder`/PROGRAM.log, mode 0600. A missing folder is made with mode 0700.
void start_file(const std::string& program, const std::string& folder);
void debug(std::string_view text);
void info(std::string_view text);
void warning(std::string_view text);
void error(std::string_view text);
// Logs the counts of suppressed lines. In each window of 10 s the log passes at most 10 lines of one kind and 200 of
// all kinds. The limits do not apply to debug(), to_file() and the lines of this function.
// ended: kinds whose window has ended, for Session::heartbeat(). all: every kind, for the end of run_program().
enum class SuppressedKinds { ended, all };
void report_suppressed(SuppressedKinds which);
// Writes a line to the log file only, for text that standard error already shows in another form.
void to_file(std::string_view text);

}  // namespace yars::log
