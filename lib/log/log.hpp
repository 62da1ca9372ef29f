// Log of a program: lines on standard error and in a file, repeats counted instead of written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace yars::log {

// Lets the first lines of a kind through and counts the rest, so that a flood is one story in the log and in the flight
// recorder. Lines are of one kind that differ in digits alone, or in what follows ", found". No clock of its own.
class RepeatFilter {
 public:
  static constexpr std::int64_t kWindow_ns = 10'000'000'000;  // [ns] from the first line of a kind on
  static constexpr std::size_t kMaxKinds = 64;                // more at a time count together

  // Lines that pass within a window: of one kind, and of all kinds together.
  RepeatFilter(int most_of_a_kind, int most_of_all) : most_of_a_kind_(most_of_a_kind), most_of_all_(most_of_all) {}

  // `now_ns` of CLOCK_MONOTONIC.
  bool passes(std::string_view line, std::int64_t now_ns);

  struct LeftOut {
    std::string line;  // the newest of them
    std::uint64_t count;
    std::string text() const { return line + " (and " + std::to_string(count - 1) + " more like it)"; }
  };
  // Kinds whose window is over and of which lines were left out, each once. `all`: also those whose window is not over.
  std::vector<LeftOut> take_left_out(std::int64_t now_ns, bool all = false);

 private:
  struct Kind {
    std::string key;
    std::int64_t begin_ns;
    int passed;
    LeftOut left_out;
  };
  Kind& kind_of(std::string_view line, std::int64_t now_ns);

  int most_of_a_kind_, most_of_all_;
  std::vector<Kind> kinds_;
  std::int64_t window_ns_ = 0;  // begin of the present window of all kinds
  int passed_ = 0;              // within it
};

// The programs' log: lines on standard error, and in a file of the session's log folder when one is named. A thin face
// over spdlog, so that only one source pays for its headers.
inline constexpr std::size_t kLogFileBytes = std::size_t{4} << 20;  // [bytes] then the file is rotated
inline constexpr std::size_t kOldLogFiles = 3;                      // PROGRAM.1.log is the newest of them

// Level names: trace, debug, info, warning, error, off. False: no such level.
bool start(const std::string& program, const std::string& level);
// From here on the log also goes to `folder`/PROGRAM.log, mode 0600; the folder is made, mode 0700. What cannot be
// written is one warning. Call it after start.
void start_file(const std::string& program, const std::string& folder);
void debug(std::string_view text);
void info(std::string_view text);
void warning(std::string_view text);
void error(std::string_view text);
// Of lines of one kind (RepeatFilter) ten pass within 10 s, of all kinds two hundred; the rest are counted. This tells
// of those whose time is over, or at the end of the program of all. Session::heartbeat() and run_program() call it.
enum class LeftOut { over, all };
void left_out(LeftOut which);
// A line for the file alone: standard error has it already, in other words.
void to_file(std::string_view text);

}  // namespace yars::log
