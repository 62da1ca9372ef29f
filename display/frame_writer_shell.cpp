#include "display/frame_writer_shell.hpp"

#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <system_error>

namespace yars::display {

failure::Expected<FrameWriter> FrameWriter::create(const std::filesystem::path& folder, double every_s) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem)
    return failure::fail(folder.string(), "a folder for frames", problem.message(), "choose another --frames");
  return FrameWriter(folder, std::llround(every_s * 1e9));
}

bool FrameWriter::is_due(std::int64_t sim_time_ns) {
  const std::int64_t step = sim_time_ns / every_ns_;
  if (step == step_) return false;
  step_ = step;
  return true;
}

failure::Expected<void> FrameWriter::write(const imageio::Image& image) const {
  return write_numbered(image, step_);
}

failure::Expected<void> FrameWriter::write_last(const imageio::Image& image, std::int64_t sim_time_ns) const {
  return write_numbered(image, (sim_time_ns + every_ns_ - 1) / every_ns_);
}

failure::Expected<void> FrameWriter::write_numbered(const imageio::Image& image, std::int64_t number) const {
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
