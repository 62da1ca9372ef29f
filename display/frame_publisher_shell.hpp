// Puts the pictures of the glass into the session's pool of frames (databuffer/frame_pool.hpp), where other programs
// read the newest. One process of a session does so, the holder of Role::glass_frames. What it has published stays when
// it stops or dies; a successor's ids go on above it.
#pragma once

#include <cstdint>

#include "databuffer/session.hpp"
#include "display/host/glass.hpp"
#include "display/picture.hpp"

namespace yars::display {

class FramePublisher {
 public:
  // `size` [pixels] of the glass. Errors, all of the command line: a glass that the pool has no room for, another
  // process that publishes.
  static failure::Expected<FramePublisher> create(databuffer::Session& session, int size);

  // The glass has painted another picture.
  void note_painted() { unpublished_ = true; }
  // Orders a copy of what is painted, publishes what has been copied; waits for nothing. Call it at each look.
  void work(host::Glass& glass, int size);
  // Publishes what is painted, waiting for the graphics processor.
  void publish_at_once(host::Glass& glass);

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
