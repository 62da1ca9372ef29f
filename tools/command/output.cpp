#include "tools/command/output.hpp"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
#include "lib/text/plain_text.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

bool names_file(const std::string& name) {
  return !name.empty() && name != kNoFile;
}

void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings) {
  const std::string ending = ending_of(name);
  if (!names_file(name)) return;
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) {
    // place() is never called, so the destructor of NewFile discards the file.
    if (const auto begun = file::NewFile::create(name); !begun) throw_failure(begun.error());
    return;
  }
  std::string expected = "a name that ends in " + endings.front();
  for (std::size_t i = 1; i < endings.size(); ++i) expected += (i + 1 < endings.size() ? ", " : " or ") + endings[i];
  throw_failure(error::usage_error(option, expected, name));
}

void check_folder_name(const std::string& option, const std::string& name) {
  static const std::vector<std::string> kFiles = {".png", ".tif", ".tiff", ".jp2", ".img", ".csv", ".f32", ".hgt",
                                                  ".zip", ".gz",  ".dt0",  ".dt1", ".dt2", ".ded", ".flt", ".guf"};
  const std::string ending = ending_of(name);
  if (std::find(kFiles.begin(), kFiles.end(), ending) != kFiles.end())
    throw_failure(error::usage_error(option, "the name of a folder", name + ", which ends like the name of a file"));
}

error::Expected<void> write_floats(const std::filesystem::path& path, std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little, "the file has the bytes of the array");
  return file::write_file(path, std::as_bytes(values));
}

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

namespace {

constexpr std::size_t kMaxItemsWithOwnLine = 64;  // with more items: at most one line per second

std::string duration_text(double seconds) {
  const long total_s = std::lround(seconds);
  if (total_s < 60) return std::to_string(total_s) + " s";
  return std::to_string(total_s / 60) + " min " + std::to_string(total_s % 60) + " s";
}

}  // namespace

Progress::Progress(std::size_t total)
    : terminal_(isatty(STDERR_FILENO) != 0),
      total_(total),
      start_time_(std::chrono::steady_clock::now()),
      last_print_time_(start_time_) {}

void Progress::done(const std::string& note) {
  ++done_;
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  const bool print_each = total_ <= kMaxItemsWithOwnLine && !note.empty();
  const bool completes_list = done_ == total_ && last_print_time_ != start_time_;
  if (!print_each && !completes_list && now - last_print_time_ < std::chrono::seconds(1)) return;
  last_print_time_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_time_).count();
  const double left_s = elapsed_s / static_cast<double>(done_) * static_cast<double>(total_ - done_);
  const std::string left = done_ == total_ ? "" : "  about " + duration_text(left_s) + " left";
  std::fprintf(stderr, "%zu/%zu  %s%s\n", done_, total_, note.c_str(), left.c_str());
}

ProgressLine::ProgressLine() {
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal != nullptr && std::string_view(terminal) == "dumb";
  terminal_ = !is_dumb && isatty(STDERR_FILENO) != 0;
}

void ProgressLine::show(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || (text.empty() ? !shown_ : now - last_print_time_ < std::chrono::milliseconds(100))) return;
  // Writes to the descriptor: the stream stderr escapes control characters (sanitize_terminal_output() in process.hpp).
  const std::string line = "\r\033[K" + text::printable(text);
  const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  if (written < 0) return;
  shown_ = !text.empty();
  last_print_time_ = now;
}

}  // namespace yars::tools
