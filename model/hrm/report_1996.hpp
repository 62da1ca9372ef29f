// Patch map of the preset `1996`, after the report of 1996: brightness in plan view, without layover.
// Brightness is the dot product of the surface's unit normal and the unit vector to the radar, at least 0. It replaces
// power in MapImage.
// Points in shadow and voids are black. Video is 255 * brightness / full scale * (1 + noise * u), at most 255.
// u is uniform in [-1, 1]. Full scale is 2.5 times the brightness of level ground at the map's centre.
// The report does not define facets. Here a facet is the slope between neighbouring grid points. A wall is thus a steep
// facet, from the grid point at its foot to the grid point on its top.
// Colours for materials are left out, because the report gives no rule for them. The preset's earth is flat.
// Source: report, "HRM patch map" and class RsSarMode; docs/spec/physics.md#preset-1996,
//   docs/decisions/0020-brightness-of-the-preset-1996.md.
#pragma once

#include <cstdint>

#include "model/hrm/algorithm.hpp"
#include "model/hrm/scene_raster.hpp"

namespace yars::model::hrm {

class Report1996 : public Algorithm {
 public:
  explicit Report1996(const physics::RadarParameters& parameters);

  int cells_per_pixel() const override { return cells_per_pixel_; }
  bool uses_crests() const override { return false; }
  bool uses_sectors() const override { return true; }
  void begin(const PatchData& data) override;
  void draw_scene(const PatchInputs& inputs, PatchData& data) override;
  // Computes the brightness of each point of the polar grid.
  void cast_profiles(const PatchInputs& inputs, PatchData& data) override;
  void draw_pixels(const PatchInputs& inputs, PatchData& data) override;
  // Forms video with the fidelity's `map_noise`. The noise depends on seed, number of the map and pixel alone.
  void draw_video(const PatchInputs& inputs, PatchData& data) override;

 private:
  int cells_per_pixel_;
  double noise_;
  std::uint64_t seed_;
  PolarScene scene_;
  PolarArray<float> brightness_;  // by PolarGrid::at()
};

}  // namespace yars::model::hrm
