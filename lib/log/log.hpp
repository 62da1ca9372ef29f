// Log of a program: lines on standard error and in a file. Repeated lines are counted instead of written.
// Inputs: text of one line; its level is the function that is called.
// Outputs: standard error and, after start_file(), FOLDER/PROGRAM.log. Control characters are escaped.
// Errors: a log file that cannot be written is reported once, as a warning.
// Threads: any thread may write lines; start() and start_file() come before the first line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace yars::log {

// Rate limit for log lines by kind. It passes the first lines of a kind in a window of 10 s and counts the rest.
// Lines are of one kind when they differ only in digits or in the text after ", found". The caller supplies the time.
class RepeatFilter {
 public:
  static constexpr std::int64_t kWindow_ns = 10'000'000'000;  // [ns] from the first line of a kind
  static constexpr std::size_t kMaxKinds = 64;                // with one kind less, all further lines share one count

  // Number of lines that pass within a window: of one kind, and of all kinds together.
  RepeatFilter(int max_per_kind, int max_total) : max_per_kind_(max_per_kind), max_total_(max_total) {}

  // True if the line passes; otherwise it is counted. `now_ns` [ns] is a time of CLOCK_MONOTONIC.
  bool passes(std::string_view line, std::int64_t now_ns);

  struct Suppressed {
    std::string line;  // the newest line that was left out
    std::uint64_t count;
    std::string text() const { return line + " (and " + std::to_string(count - 1) + " more like it)"; }
  };
  // Returns and forgets the counts of kinds whose window has ended. With `all`, also of kinds whose window is open.
  std::vector<Suppressed> take_suppressed(std::int64_t now_ns, bool all = false);

 private:
  struct Kind {
    std::string key;
    std::int64_t begin_ns;
    int passed;
    Suppressed suppressed_text;
  };
  Kind& kind_of(std::string_view line, std::int64_t now_ns);

  int max_per_kind_, max_total_;
  std::vector<Kind> kinds_;
  std::int64_t window_begin_ns_ = 0;  // [ns] of the current window of all kinds
  int passed_in_window_ = 0;          // lines of all kinds
};

// The functions below are an interface to spdlog, whose headers only log.cpp includes.
inline constexpr std::size_t kLogFileBytes = std::size_t{4} << 20;  // [bytes] a larger file is rotated
inline constexpr std::size_t kOldLogFiles = 3;                      // PROGRAM.1.log is the newest of them

// Starts the log on standard error. Levels: trace, debug, info, warning, error, off. False: `level` is none of them.
bool start(const std::string& program, const std::string& level);
// After start(): also writes the log to `folder`/PROGRAM.log, mode 0600. A missing folder is made with mode 0700.
void start_file(const std::string& program, const std::string& folder);
void debug(std::string_view text);
void info(std::string_view text);
void warning(std::string_view text);
void error(std::string_view text);
// Logs the number of lines that were left out. Within 10 s the log writes ten lines of one kind and 200 of all kinds.
// over: kinds whose window has ended; all: every kind, at the end of the program.
// Session::heartbeat() and run_program() call it.
enum class Suppressed { over, all };
void suppressed_text(Suppressed which);
// Writes a line to the file only, for text that standard error already has in another form.
void to_file(std::string_view text);

}  // namespace yars::log
