#include "display/frame_writer_shell.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>
#include <system_error>

namespace yars::display {

failure::Expected<FrameWriter> FrameWriter::create(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem)
    return failure::fail(folder.string(), "a folder for frames", problem.message(), "choose another --frames");
  // Where others may write they can plant links under the names to come.
  const auto rights = std::filesystem::status(folder, problem).permissions();
  if (problem || (rights & std::filesystem::perms::others_write) != std::filesystem::perms::none)
    return failure::fail(folder.string(), "a folder that no other user may write to", "one that any user may",
                         "choose another --frames, such as a new folder in it");
  return FrameWriter(folder);
}

failure::Expected<void> FrameWriter::write(const imageio::Image& image, std::int64_t number) const {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "frame_%06" PRId64 ".png", number);
  const std::filesystem::path path = folder_ / name.data();
  std::filesystem::path part = path;
  part += ".part";
  if (auto written = imageio::write_png(part, image); !written) return written;
  std::error_code problem;
  std::filesystem::rename(part, path, problem);
  if (problem) return failure::fail(path.string(), "to rename a frame into place", problem.message());
  return {};
}

}  // namespace yars::display
