// Writes pictures of the glass as frame_NNNNNN.png (numbers: frame_steps.hpp). A reader never finds half a picture, and
// one that could not be written leaves nothing behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "lib/failure/error.hpp"
#include "lib/file/folder.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display {

class FrameWriter {
 public:
  // Makes the folder, mode 0700. Only the `keep` newest frames stay in it, those of earlier runs among them; 0: all
  // stay. An error: folder.hpp's make_private.
  static failure::Expected<FrameWriter> create(const std::filesystem::path& folder, std::size_t keep = 0);

  failure::Expected<void> write(const imageio::Image& image, std::int64_t number);

 private:
  FrameWriter(std::shared_ptr<const file::Folder> folder, std::size_t keep);
  void make_room_for(const std::string& name);

  std::shared_ptr<const file::Folder> folder_;
  std::size_t keep_;
  std::deque<std::string> names_;  // of the frames in the folder, the oldest first; empty where all stay
};

}  // namespace yars::display
