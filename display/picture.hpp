// A picture of the glass as bytes, with the moment that it shows.
#pragma once

#include <cstdint>
#include <vector>

namespace yars::display {

struct Picture {
  std::int64_t tick = 0;             // of the radar state that is on it
  std::int64_t sim_time_ns = 0;      // [ns] of the glass's last look at the session
  int size = 0;                      // [pixels] to the edge of the square
  std::vector<std::uint8_t> pixels;  // rows from the top without padding, red, green, blue, 255
};

}  // namespace yars::display
