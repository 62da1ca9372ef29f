// Pictures that leave the program: when one is due, into a folder, into the segment.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "databuffer/session/session.hpp"
#include "display/gl/framebuffer.hpp"
#include "display/host/display.hpp"
#include "lib/error/error.hpp"
#include "lib/file/folder.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display {

// When a picture of the glass is due: once for each step of sim time. The number of a step is the sim time in steps,
// so that a restarted glass goes on where it was.
class FrameSteps {
 public:
  explicit FrameSteps(double every_s) : every_ns_(std::llround(every_s * 1e9)) {}  // > 0

  // True once for each step that has been reached; a step back in time (a new epoch) is a new one.
  bool is_due(std::int64_t sim_time_ns) {
    const std::int64_t step = sim_time_ns / every_ns_;
    if (step == step_) return false;
    step_ = step;
    return true;
  }
  std::int64_t number() const { return step_; }
  // Of a last picture at a time between two steps: that of the step to come.
  std::int64_t last_number(std::int64_t sim_time_ns) const { return (sim_time_ns + every_ns_ - 1) / every_ns_; }

 private:
  std::int64_t every_ns_;
  std::int64_t step_ = -1;
};

// Writes pictures of the glass as frame_NNNNNN.png. A reader never finds half a
// picture, and one that could not be written leaves nothing behind.
class FrameWriter {
 public:
  // Makes the folder, mode 0700. Only the `keep` newest frames stay in it, those of earlier runs among them; 0: all
  // stay. An error: folder.hpp's make_private.
  static error::Expected<FrameWriter> create(const std::filesystem::path& folder, std::size_t keep = 0);

  error::Expected<void> write(const imageio::Image& image, std::int64_t number);

 private:
  FrameWriter(std::shared_ptr<const file::Folder> folder, std::size_t keep);
  void make_room_for(const std::string& name);

  std::shared_ptr<const file::Folder> folder_;
  std::size_t keep_;
  std::deque<std::string> names_;  // of the frames in the folder, the oldest first; empty where all stay
};

// Puts the pictures of the glass into the session's pool of frames (databuffer/session/picture_pool.hpp), where other
// programs read the newest. One process of a session does so, the holder of Role::glass_frames. What it has published
// stays when it stops or dies; a successor's ids go on above it.
class FramePublisher {
 public:
  // `size` [pixels] of the glass. Errors, all of the command line: a glass that the pool has no room for, another
  // process that publishes.
  static error::Expected<FramePublisher> create(databuffer::Session& session, int size);

  // The glass has painted another picture.
  void note_painted() { unpublished_ = true; }
  // Orders a copy of what is painted, publishes what has been copied; waits for nothing. Call it at each look.
  void work(host::Display& glass, int size);
  // Publishes what is painted, waiting for the graphics processor.
  void publish_at_once(host::Display& glass);

 private:
  FramePublisher(databuffer::Session& session, databuffer::Claim claim);
  void publish();

  databuffer::Session* session_;
  databuffer::Claim claim_;
  Picture picture_;
  std::uint64_t last_id_;
  bool unpublished_ = false;
  bool told_of_size_ = false;
};

}  // namespace yars::display
