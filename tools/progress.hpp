// Progress of a long command on standard output or another stream: a line a second at most, how much is done and how
// long it will take; in short work also a line for each thing done.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

namespace yars::tools {

class Progress {
 public:
  explicit Progress(std::size_t total, std::FILE* out = stdout);
  // One more is done; `note` says what, empty = nothing to say.
  void done(const std::string& note);

 private:
  std::FILE* out_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point began_;
  std::chrono::steady_clock::time_point said_;
};

// A line on standard error that is written over, at most ten times a second, where that is a terminal; else nothing.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { say(""); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  // Empty: the line is wiped.
  void say(const std::string& text);

 private:
  bool shown_ = false;
  bool terminal_;
  std::chrono::steady_clock::time_point said_;
};

}  // namespace yars::tools
