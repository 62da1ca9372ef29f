#include "display/app/frame_output_shell.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "databuffer/session/picture_pool.hpp"
#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
#include "lib/log/log.hpp"

namespace yars::display {

namespace {

// True for names like frame_000123.png.
bool is_frame(const std::string& name) {
  constexpr std::string_view kBegin = "frame_";
  constexpr std::string_view kEnd = ".png";
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd) || name.size() <= kBegin.size() + kEnd.size()) return false;
  const auto number = std::string_view(name).substr(kBegin.size(), name.size() - kBegin.size() - kEnd.size());
  return std::ranges::all_of(number, [](char digit) { return digit >= '0' && digit <= '9'; });
}

// Names of the frames in a folder, oldest first.
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

error::Expected<FrameWriter> FrameWriter::create(const std::filesystem::path& folder, std::size_t keep) {
  auto opened = file::Folder::make_private(folder);
  if (!opened) return tl::unexpected(opened.error());
  return FrameWriter(std::make_shared<const file::Folder>(std::move(*opened)), keep);
}

// Makes or opens a folder at the path if the path no longer leads to the opened folder.
error::Expected<void> FrameWriter::return_to_path() {
  if (folder_->is_at_path()) return {};
  auto reopened = create(folder_->path(), keep_);
  if (!reopened) return tl::unexpected(reopened.error());
  *this = std::move(*reopened);
  return {};
}

error::Expected<void> FrameWriter::write_file(const std::string& name, const imageio::Image& image) const {
  auto frame = file::NewFile::create(folder_, name, file::Rights::user_alone);
  if (!frame) return tl::unexpected(frame.error());
  return imageio::write_png(std::move(*frame), image);
}

error::Expected<void> FrameWriter::write(const imageio::Image& image, std::int64_t number) {
  if (auto returned = return_to_path(); !returned) return returned;
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "frame_%06" PRId64 ".png", number);
  auto written = write_file(name.data(), image);
  if (!written && keep_ > 0 && names_.size() >= keep_ && disk_is_full(image.pixels.size())) {
    remove_oldest(keep_ - 1);
    written = write_file(name.data(), image);
  }
  if (!written || keep_ == 0) return written;
  std::erase(names_, name.data());  // a frame of the same number has just been replaced
  names_.emplace_back(name.data());
  remove_oldest(keep_);
  return {};
}

bool FrameWriter::disk_is_full(std::size_t needed_bytes) const {
  std::error_code problem;
  const auto space = std::filesystem::space(folder_->path(), problem);
  return !problem && space.available < needed_bytes;
}

void FrameWriter::remove_oldest(std::size_t kept) {
  while (names_.size() > kept) {
    folder_->remove(names_.front());
    names_.pop_front();
  }
}

namespace {

constexpr int kMaxPixels = static_cast<int>(databuffer::kMaxFramePixels);

}  // namespace

error::Expected<FramePublisher> FramePublisher::create(databuffer::Session& session, int size) {
  if (size > kMaxPixels)
    return tl::unexpected(error::usage_error(
        "--publish", "a display of at most " + std::to_string(kMaxPixels) + " pixels, the limit of a published frame",
        std::to_string(size), "give --size " + std::to_string(kMaxPixels) + " or less"));
  auto claim = session.claim(databuffer::Role::glass_frames);
  if (!claim) return tl::unexpected(error::usage_error(claim.error()));
  return FramePublisher(session, std::move(*claim));
}

FramePublisher::FramePublisher(databuffer::Session& session, databuffer::Claim claim)
    : session_(&session),
      claim_(std::move(claim)),
      last_id_(databuffer::greatest_id<shm::PlainAccess>(session.layout().frames)) {}

void FramePublisher::work(host::Display& mpd, int size) {
  while (mpd.take_read(picture_)) publish();
  if (size > kMaxPixels) {
    if (!std::exchange(size_warned_, true))
      log::warning("the window is larger than the largest frame (" + std::to_string(kMaxPixels) +
                   " pixels): no frame is published until the window is smaller");
    return;
  }
  if (unpublished_ && mpd.start_reading()) unpublished_ = false;
}

void FramePublisher::publish_at_once(host::Display& mpd) {
  unpublished_ = false;
  while (mpd.wait_for_read(picture_)) publish();  // readbacks that were started earlier
  if (mpd.start_reading() && mpd.wait_for_read(picture_)) publish();
}

void FramePublisher::publish() {
  databuffer::GlassFrame frame{};
  if (++last_id_ > databuffer::kLatestPictureId) last_id_ = 1;
  frame.id = last_id_;
  frame.tick = picture_.tick;
  frame.sim_time_ns = picture_.sim_time_ns;
  frame.width = static_cast<std::uint32_t>(picture_.size);
  frame.height = frame.width;
  databuffer::publish_frame(session_->layout(), frame, picture_.pixels);
}

}  // namespace yars::display
