#include "display/frame_writer_shell.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>
#include <utility>

namespace yars::display {

failure::Expected<FrameWriter> FrameWriter::create(const std::filesystem::path& folder) {
  auto opened = file::Folder::make_private(folder);
  if (!opened) return tl::unexpected(opened.error());
  return FrameWriter(std::make_shared<const file::Folder>(std::move(*opened)));
}

failure::Expected<void> FrameWriter::write(const imageio::Image& image, std::int64_t number) const {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "frame_%06" PRId64 ".png", number);
  auto frame = file::NewFile::create(folder_, name.data(), file::Rights::user_alone);
  if (!frame) return tl::unexpected(frame.error());
  return imageio::write_png(std::move(*frame), image);
}

}  // namespace yars::display
