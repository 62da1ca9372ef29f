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

}  // namespace yars::tools
