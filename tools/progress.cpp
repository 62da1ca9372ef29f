#include "tools/progress.hpp"

#include <unistd.h>

#include <cmath>

#include "lib/failure/printable.hpp"

namespace yars::tools {

namespace {

constexpr std::size_t kShort = 64;  // things; each has its line

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return std::to_string(whole) + " s";
  return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

}  // namespace

Progress::Progress(std::size_t total, std::FILE* out)
    : out_(out), total_(total), began_(std::chrono::steady_clock::now()), said_(began_) {}

void Progress::done(const std::string& note) {
  ++done_;
  const auto now = std::chrono::steady_clock::now();
  const bool each = total_ <= kShort && !note.empty();
  if (!each && now - said_ < std::chrono::seconds(1)) return;
  said_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - began_).count();
  const double left_s = elapsed_s / static_cast<double>(done_) * static_cast<double>(total_ - done_);
  const std::string left = done_ == total_ ? "" : "  about " + duration_text(left_s) + " left";
  std::fprintf(out_, "%zu/%zu  %s%s\n", done_, total_, note.c_str(), left.c_str());
  std::fflush(out_);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::say(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || (text.empty() ? !shown_ : now - said_ < std::chrono::milliseconds(100))) return;
  // Past the guard of the terminal (databuffer/terminal_guard.hpp), which lets no control characters through.
  const std::string line = "\r\033[K" + failure::printable(text);
  const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  if (written < 0) return;
  shown_ = !text.empty();
  said_ = now;
}

}  // namespace yars::tools
