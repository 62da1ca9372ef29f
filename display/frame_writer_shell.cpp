#include "display/frame_writer_shell.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace yars::display {

namespace {

bool is_frame(const std::string& name) {
  constexpr std::string_view kBegin = "frame_";
  constexpr std::string_view kEnd = ".png";
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd) || name.size() <= kBegin.size() + kEnd.size()) return false;
  const auto number = std::string_view(name).substr(kBegin.size(), name.size() - kBegin.size() - kEnd.size());
  return std::ranges::all_of(number, [](char digit) { return digit >= '0' && digit <= '9'; });
}

// What was there before, by age.
std::deque<std::string> frames_in(const std::filesystem::path& folder) {
  std::vector<std::pair<std::filesystem::file_time_type, std::string>> found;
  std::error_code problem;
  for (auto it = std::filesystem::directory_iterator(folder, problem); it != end(it); it.increment(problem)) {
    const std::string name = it->path().filename().string();
    std::error_code gone;
    const auto time = std::filesystem::last_write_time(it->path(), gone);
    if (is_frame(name) && !gone) found.emplace_back(time, name);
  }
  std::ranges::sort(found);
  std::deque<std::string> names;
  for (auto& [time, name] : found) names.push_back(std::move(name));
  return names;
}

}  // namespace

FrameWriter::FrameWriter(std::filesystem::path folder, std::size_t keep) : folder_(std::move(folder)), keep_(keep) {
  if (keep_ > 0) names_ = frames_in(folder_);
}

failure::Expected<FrameWriter> FrameWriter::create(const std::filesystem::path& folder, std::size_t keep) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem)
    return failure::fail(folder.string(), "a folder for frames", problem.message(), "choose another --frames");
  // Where others may write they can plant links under the names to come.
  const auto rights = std::filesystem::status(folder, problem).permissions();
  if (problem || (rights & std::filesystem::perms::others_write) != std::filesystem::perms::none)
    return failure::fail(folder.string(), "a folder that no other user may write to", "one that any user may",
                         "choose another --frames, such as a new folder in it");
  return FrameWriter(folder, keep);
}

failure::Expected<void> FrameWriter::write(const imageio::Image& image, std::int64_t number) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "frame_%06" PRId64 ".png", number);
  const std::filesystem::path path = folder_ / name.data();
  make_room_for(name.data());
  std::filesystem::path part = path;
  part += ".part";
  std::error_code problem;
  if (auto written = imageio::write_png(part, image); !written) {
    std::filesystem::remove(part, problem);
    return written;
  }
  std::filesystem::rename(part, path, problem);
  if (problem) return failure::fail(path.string(), "to rename a frame into place", problem.message());
  if (keep_ > 0) names_.emplace_back(name.data());
  return {};
}

// Before it is written: a disk that is full takes it then. A frame of the same number is replaced.
void FrameWriter::make_room_for(const std::string& name) {
  std::erase(names_, name);
  std::error_code problem;
  while (keep_ > 0 && names_.size() >= keep_) {
    std::filesystem::remove(folder_ / names_.front(), problem);
    names_.pop_front();
  }
}

}  // namespace yars::display
