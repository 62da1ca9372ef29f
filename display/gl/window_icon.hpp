// Icon of the windows: the sector of a scan with its range arcs.
// Outputs: square RGBA images.
#pragma once

#include "lib/imageio/png.hpp"

namespace yars::display::gl {

// `size`: edge [pixels], 16 or more.
imageio::Image window_icon(int size);

}  // namespace yars::display::gl
