// Output of a command: names checked before the work, files of numbers, progress.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::tools {

// Whether outputs can be written where they are named, found out before the work begins.
// Each throws CommandFailed and says what is expected.

// ".png", of whatever case.
std::string ending_of(const std::string& name);

// A file whose name ends in one of `endings` (".png"), in a folder that is there and may be written to; an empty name
// is no file.
void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings);

// A folder: no name that ends like one of the files that YARS writes or reads.
void check_folder_name(const std::string& option, const std::string& name);

// Rows of numbers as a file of 32-bit floats: little endian on every machine, row by row, no header.

// Errors: the file cannot be written.
error::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values);

// Progress of a long command on standard output or another stream: a line a second at most, how much is done and how
// long it will take; in short work also a line for each thing done.
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
