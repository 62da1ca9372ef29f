// Lets the first lines of a kind through and counts the rest, so that a flood is one story in the log and in the flight
// recorder. Lines are of one kind that differ in digits alone, or in what follows ", found". No clock of its own.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace yars::databuffer {

class RepeatFilter {
 public:
  static constexpr std::int64_t kWindow_ns = 10'000'000'000;  // [ns] from the first line of a kind on
  static constexpr std::size_t kMostKinds = 64;               // more at a time count together

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

}  // namespace yars::databuffer
