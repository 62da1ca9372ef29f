// Writes pictures of the glass as frame_NNNNNN.png (numbers: frame_steps.hpp). A reader never finds half a picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "lib/failure/error.hpp"
#include "lib/file/folder.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display {

class FrameWriter {
 public:
  // Makes the folder, mode 0700. An error: folder.hpp's make_private.
  static failure::Expected<FrameWriter> create(const std::filesystem::path& folder);

  failure::Expected<void> write(const imageio::Image& image, std::int64_t number) const;

 private:
  explicit FrameWriter(std::shared_ptr<const file::Folder> folder) : folder_(std::move(folder)) {}

  std::shared_ptr<const file::Folder> folder_;
};

}  // namespace yars::display
