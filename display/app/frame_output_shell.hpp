// Output of display pictures: PNG files in a folder, frames in the segment.
// Inputs: pictures of the display; sim time.
// Outputs: files frame_NNNNNN.png; frames in the session's pool (databuffer/session/picture_pool.hpp).
// Errors: an unusable folder; a picture too large for the pool; another process that publishes frames of the session.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "databuffer/session/session.hpp"
#include "display/gl/gpu_objects.hpp"
#include "display/host/display.hpp"
#include "lib/error/error.hpp"
#include "lib/file/folder.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display {

// Schedule of frames: one frame for each step of `every_s` seconds of sim time. The number of a step is its sim time
// divided by `every_s`, rounded down, so that a restarted display continues the numbers.
class FrameSteps {
 public:
  explicit FrameSteps(double every_s) : every_ns_(std::llround(every_s * 1e9)) {}  // every_s > 0

  // Returns true at the first call in each step, also after a jump back in time (a new epoch).
  bool is_due(std::int64_t sim_time_ns) {
    const std::int64_t step = sim_time_ns / every_ns_;
    if (step == step_) return false;
    step_ = step;
    return true;
  }
  // Number of the step of the last is_due(); -1 before the first call.
  std::int64_t number() const { return step_; }
  // Number of the final picture, painted at `sim_time_ns`. Unless a step begins exactly then, it is the
  // number of the next step.
  std::int64_t last_number(std::int64_t sim_time_ns) const { return (sim_time_ns + every_ns_ - 1) / every_ns_; }

 private:
  std::int64_t every_ns_;
  std::int64_t step_ = -1;
};

// Writes pictures as frame_NNNNNN.png. A reader never finds a partial file. A failed write leaves the folder
// unchanged, with one exception: on a full disk, and if `keep` is not 0, the oldest frames are removed to make space,
// until `keep` - 1 are left.
class FrameWriter {
 public:
  // Makes a missing folder, mode 0700. `keep`: number of newest frames that stay in the folder, frames of earlier runs
  // included; 0: all. Error: the folder cannot be made or used.
  // If the folder is moved or replaced later, the next write makes or opens a folder at the path `folder`, with the
  // same checks.
  static error::Expected<FrameWriter> create(const std::filesystem::path& folder, std::size_t keep = 0);

  error::Expected<void> write(const imageio::Image& image, std::int64_t number);

 private:
  FrameWriter(std::shared_ptr<const file::Folder> folder, std::size_t keep);
  error::Expected<void> return_to_path();
  error::Expected<void> write_file(const std::string& name, const imageio::Image& image) const;
  // False if the free space of the disk is unknown.
  bool disk_is_full(std::size_t needed_bytes) const;
  // Removes the oldest frames until `kept` are left.
  void remove_oldest(std::size_t kept);

  std::shared_ptr<const file::Folder> folder_;
  std::size_t keep_;
  std::deque<std::string> names_;  // names of the frames in the folder, oldest first; empty if all are kept
};

// Publishes pictures in the session's frame pool, where other programs read the newest picture. Only the process that
// holds Role::glass_frames publishes. Published frames stay when that process ends. Its successor continues the ids.
class FramePublisher {
 public:
  // `size`: edge of the display [pixels]. Usage errors: a size beyond kMaxFramePixels, another process that publishes.
  static error::Expected<FramePublisher> create(databuffer::Session& session, int size);

  // Marks the current picture of the display as not yet published.
  void note_painted() { unpublished_ = true; }
  // Publishes pictures that have arrived from the GPU. If the current picture is not yet published, starts its readback
  // (copy from the GPU); if `size` exceeds kMaxFramePixels, logs one warning instead. Never waits. Call work() after
  // each update. `size`: edge of the display [pixels].
  void work(host::Display& mpd, int size);
  // Publishes the pictures whose readback has begun, then the current picture. Waits for the GPU.
  void publish_at_once(host::Display& mpd);

 private:
  FramePublisher(databuffer::Session& session, databuffer::Claim claim);
  void publish();

  databuffer::Session* session_;
  databuffer::Claim claim_;
  Picture picture_;
  std::uint64_t last_id_;
  bool unpublished_ = false;
  bool size_warned_ = false;
};

}  // namespace yars::display
