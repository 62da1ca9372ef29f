// Patch map of the preset `1996`: orthographic brightness instead of power, without layover.
// Brightness: dot product of the surface normal and the direction to the radar, 0 to 1; it replaces power in MapImage.
// Points in shadow and voids are black. Video is proportional to brightness * (1 + noise * u), u uniform in [-1, 1).
// Chosen here, open in the report: a facet spans neighbours of the grid, so a wall is the facet up to its top.
// Left out: the report's colours for materials, for which it gives no rule. The earth is flat by the preset's fidelity.
// Source: report, "HRM patch map" and class RsSarMode; docs/spec/physics.md#preset-1996.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm {

// Inputs after ground and scene are drawn: surface by PolarGrid::at(), horizon by column.
struct ShadingInputs {
  const SurfacePoint* surface = nullptr;  // gain +0 marks a point without ground
  const float* horizon = nullptr;         // greatest tangent before row 0
};

// Computes the brightness of the columns [first, last), by PolarGrid::at(). Reads the heights of neighbouring columns.
void shade_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const ShadingInputs& inputs, int first,
                      int last, float* brightness);

// Interpolates rows [first, last) of the map bilinearly from the polar grid.
void draw_brightness(const PatchGeometry& geometry, const PolarGrid& grid, const float* brightness, int first, int last,
                     MapImage& image);

// Forms video with the fidelity's `map_noise`; seed and `map` are the key of the noise. Blind pixels are black.
void form_brightness_video(const radar::RadarConfiguration& configuration, const MapImage& image, std::uint32_t map,
                           std::vector<std::uint8_t>& picture);

}  // namespace yars::model::hrm
