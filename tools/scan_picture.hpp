// One scan as a picture in the geometry of the glass: ground track up, apex and scale as the configuration's view.
// Pure; every pixel takes the sample that its middle lies in, outside the scan it is black.
#pragma once

#include <cstdint>
#include <span>

#include "databuffer/records/model_records.hpp"
#include "lib/imageio/png.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::tools {

enum class ScanColor : std::uint8_t { green, gray };

// Sweeps of one scan in clockwise order, all from one place and of one range; at least one.
imageio::Image scan_picture(std::span<const databuffer::Sweep> sweeps, const radar::ViewConfiguration& view,
                            ScanColor color);

}  // namespace yars::tools
