// A patch as the 1996 report makes it: orthographic, one pass from above, brightness the dot product of the surface's
// normal and the direction to the radar. What it leaves open is defined here: facets lie between neighbours of the fan,
// so that a wall is the facet that climbs to its top; nothing behind a nearer, higher tangent returns; a void is black;
// the random number multiplies: brightness (1 + noise u), u even in [-1, 1). The report's colours, which stand in for
// materials, are left out: it gives no rule. Flat earth comes with the preset. Brightness is 0 to 1 and takes the place
// of power in MapImage; video is proportional to it. Source: report, "HRM patch map" and class RsSarMode.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm {

// By PolarGrid::at() once ground and scene are drawn; the horizon by column.
struct ShadingInputs {
  const SurfacePoint* surface = nullptr;  // gain 0 where there is no ground
  const float* horizon = nullptr;         // greatest tangent before row 0
};

// Brightness of the columns [first, last), by PolarGrid::at(). Their neighbours' heights are read.
void shade_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const ShadingInputs& inputs, int first,
                      int last, float* brightness);

// Rows [first, last) of the map, bilinear between the samples of the fan.
void draw_brightness(const PatchGeometry& geometry, const PolarGrid& grid, const float* brightness, int first, int last,
                     MapImage& image);

// Video with the configured noise; `map` and the seed name it. Blank pixels are black.
void form_brightness_video(const radar::RadarConfiguration& configuration, const MapImage& image, std::uint32_t map,
                           std::vector<std::uint8_t>& picture);

}  // namespace yars::model::hrm
