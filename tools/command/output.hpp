// Output helpers of the subcommands: checks of output names, raw float files, run times, progress reports.
// Errors: the check_... functions throw radar::Failure, before the computation starts.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::tools {

// Extension of a file name in lower case with its dot, such as ".png"; empty if there is none.
std::string ending_of(const std::string& name);

// Value of an output option that means no output file.
constexpr const char* kNoFile = "none";
// Whether the value of an output option names a file: it is neither empty nor kNoFile.
bool names_file(const std::string& name);

// Requires that `name` ends in one of `endings` (".png") and that a file can be created at this path. `option` names
// the command-line option in the message. A name without a file (names_file()) passes.
void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings);

// Requires a folder name. A name that ends like a file which YARS reads or writes (".png", ".dt1") is an error.
void check_folder_name(const std::string& option, const std::string& name);

// Writes 32-bit floats in the order given, little endian on every machine, without header.
// Errors: the file cannot be written.
error::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values);

// [ms] Reading of the steady clock. Only differences of two readings have a meaning.
double wall_ms();
// [ms] Processor time of all threads of this process since its start.
double processor_ms();
// The median; for an even number of values, the larger of the two middle values. Requires at least one value.
double median(std::vector<double> values);

// Progress of a long command on standard error: items done, total, estimated time left. Prints at most one line per
// second, and a line for the last item if a line precedes it. With 64 items or fewer it also prints each item that has
// a note. Prints nothing if standard error is not a terminal.
class Progress {
 public:
  explicit Progress(std::size_t total);
  // Counts one item as done. `note` describes it and may be empty.
  void done(const std::string& note);

 private:
  bool terminal_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point start_time_;
  std::chrono::steady_clock::time_point last_print_time_;
};

// One status line on standard error. New text overwrites it at most ten times a second. Prints nothing if standard
// error is not a terminal, or one that cannot erase a line (TERM=dumb). The destructor erases the line.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { show(""); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  // Empty text erases the line.
  void show(const std::string& text);

 private:
  bool shown_ = false;
  bool terminal_;
  std::chrono::steady_clock::time_point last_print_time_;
};

}  // namespace yars::tools
