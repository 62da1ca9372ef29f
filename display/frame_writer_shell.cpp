#include "display/frame_writer_shell.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "lib/file/new_file.hpp"

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

FrameWriter::FrameWriter(std::shared_ptr<const file::Folder> folder, std::size_t keep)
    : folder_(std::move(folder)), keep_(keep) {
  if (keep_ > 0) names_ = frames_in(folder_->path());
}

failure::Expected<FrameWriter> FrameWriter::create(const std::filesystem::path& folder, std::size_t keep) {
  auto opened = file::Folder::make_private(folder);
  if (!opened) return tl::unexpected(opened.error());
  return FrameWriter(std::make_shared<const file::Folder>(std::move(*opened)), keep);
}

failure::Expected<void> FrameWriter::write(const imageio::Image& image, std::int64_t number) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "frame_%06" PRId64 ".png", number);
  make_room_for(name.data());
  auto frame = file::NewFile::create(folder_, name.data(), file::Rights::user_alone);
  if (!frame) return tl::unexpected(frame.error());
  if (auto written = imageio::write_png(std::move(*frame), image); !written) return written;
  if (keep_ > 0) names_.emplace_back(name.data());
  return {};
}

// Before it is written: a disk that is full takes it then. A frame of the same number is replaced.
void FrameWriter::make_room_for(const std::string& name) {
  std::erase(names_, name);
  while (keep_ > 0 && names_.size() >= keep_) {
    folder_->remove(names_.front());
    names_.pop_front();
  }
}

}  // namespace yars::display
