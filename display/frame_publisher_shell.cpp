#include "display/frame_publisher_shell.hpp"

#include <string>
#include <utility>

#include "databuffer/frame_pool.hpp"
#include "databuffer/log.hpp"
#include "databuffer/program.hpp"

namespace yars::display {

namespace {

constexpr int kMostPixels = static_cast<int>(databuffer::kMostFramePixels);

}  // namespace

failure::Expected<FramePublisher> FramePublisher::create(databuffer::Session& session, int size) {
  if (size > kMostPixels)
    return tl::unexpected(databuffer::usage_error(
        "--publish", "a glass of at most " + std::to_string(kMostPixels) + " pixels, as a frame in the segment has",
        std::to_string(size), "give --size " + std::to_string(kMostPixels) + " or less"));
  auto claim = session.claim(databuffer::Role::glass_frames);
  if (!claim) return tl::unexpected(databuffer::usage_error(claim.error()));
  return FramePublisher(session, std::move(*claim));
}

FramePublisher::FramePublisher(databuffer::Session& session, databuffer::Claim claim)
    : session_(&session),
      claim_(std::move(claim)),
      last_id_(databuffer::greatest_id<shm::PlainAccess>(session.layout().frames)) {}

void FramePublisher::work(host::Glass& glass, int size) {
  while (glass.take_read(picture_)) publish();
  if (size > kMostPixels) {
    if (!std::exchange(told_of_size_, true))
      databuffer::log_warning("the window is larger than a frame may be (" + std::to_string(kMostPixels) +
                              " pixels): none is published until it is smaller");
    return;
  }
  if (unpublished_ && glass.start_reading()) unpublished_ = false;
}

void FramePublisher::publish_at_once(host::Glass& glass) {
  unpublished_ = false;
  while (glass.wait_for_read(picture_)) publish();  // what was under way
  if (glass.start_reading() && glass.wait_for_read(picture_)) publish();
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
