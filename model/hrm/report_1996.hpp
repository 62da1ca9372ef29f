// Patch map of the preset `1996`: orthographic brightness instead of power, without layover.
// Brightness: dot product of the surface normal and the direction to the radar, 0 to 1; it replaces power in MapImage.
// Points in shadow and voids are black. Video is proportional to brightness * (1 + noise * u), u uniform in [-1, 1).
// Chosen here, open in the report: a facet spans neighbours of the grid, so a wall is the facet up to its top.
// Left out: the report's colours for materials, for which it gives no rule. The earth is flat by the preset's fidelity.
// Source: report, "HRM patch map" and class RsSarMode; docs/spec/physics.md#preset-1996.
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
  void begin(const PatchData& data) override;
  void draw_scene(const PatchInputs& inputs, PatchData& data) override;
  // Computes the brightness of the polar grid.
  void cast_profiles(const PatchInputs& inputs, PatchData& data) override;
  void draw_map(const PatchInputs& inputs, PatchData& data) override;
  // Forms video with the fidelity's `map_noise`; seed and number of the map are the key of the noise.
  void draw_video(const PatchInputs& inputs, PatchData& data) override;

 private:
  int cells_per_pixel_;
  double noise_;
  std::uint64_t seed_;
  PolarScene scene_;
  PolarArray<float> brightness_;  // by PolarGrid::at()
};

}  // namespace yars::model::hrm
