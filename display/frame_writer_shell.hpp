// Writes pictures of the glass as frame_NNNNNN.png, one each `every` seconds of sim time; the number is the sim time
// in those steps, so that a restarted glass goes on where it was. A reader never finds half a picture.
#pragma once

#include <cstdint>
#include <filesystem>

#include "lib/failure/error.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display {

class FrameWriter {
 public:
  // Makes the folder. `every_s` > 0.
  static failure::Expected<FrameWriter> create(const std::filesystem::path& folder, double every_s);

  // True once for each step of sim time that has been reached; a step back in time (a new epoch) is a new one.
  bool is_due(std::int64_t sim_time_ns);
  // The picture of a step that is due.
  failure::Expected<void> write(const imageio::Image& image) const;
  // The last picture, at a time between two steps: it gets the number of the step to come.
  failure::Expected<void> write_last(const imageio::Image& image, std::int64_t sim_time_ns) const;

 private:
  FrameWriter(std::filesystem::path folder, std::int64_t every_ns) : folder_(std::move(folder)), every_ns_(every_ns) {}
  failure::Expected<void> write_numbered(const imageio::Image& image, std::int64_t number) const;

  std::filesystem::path folder_;
  std::int64_t every_ns_;
  std::int64_t step_ = -1;
};

}  // namespace yars::display
