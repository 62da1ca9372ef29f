// Default algorithm of the patch map, in float and with SIMD instructions (library Highway).
// Scene triangles are drawn onto the polar grid (ground range by azimuth) as seen from above. Cross sections of the
// grid points are computed column by column, with shadow and layover (profile_simd.hpp). Pixels are interpolated
// between these cross sections.
// Accuracy against Reference: docs/radar_maths.md, "Patch maps"; tests/model/bounds/patch_reference_test.cpp.
// Determinism: equal bits for any number of threads and any vector width.
#pragma once

#include <vector>

#include "lib/radar/fidelity.hpp"
#include "model/hrm/algorithm.hpp"
#include "model/hrm/power_picture.hpp"
#include "model/hrm/profile_simd.hpp"
#include "model/hrm/scene_raster.hpp"
#include "model/physics/atmosphere.hpp"

namespace yars::model::hrm {

class Standard : public Algorithm {
 public:
  explicit Standard(const physics::RadarParameters& parameters);

  int cells_per_pixel() const override { return fidelity_.map_oversampling; }
  bool uses_crests() const override { return true; }
  bool uses_sectors() const override { return true; }
  void begin(const PatchData& data) override;
  void draw_scene(const PatchInputs& inputs, PatchData& data) override;
  void cast_profiles(const PatchInputs& inputs, PatchData& data) override;
  void draw_pixels(const PatchInputs& inputs, PatchData& data) override;
  void complete_map(const PatchInputs& inputs, PatchData& data) override;
  void draw_video(const PatchInputs& inputs, PatchData& data) override;

 private:
  void fit_gas_rows(const PatchData& data);
  simd::Strip strip_of(PatchData& data, int number);

  radar::Fidelity fidelity_;
  double double_bounce_db_;
  physics::GasPath gas_;
  PolarScene scene_;
  PowerPicture power_picture_;
  std::vector<float> distance_m_, inverse_m_, above_plane_m_, above_level_m_;  // by row, as in simd::Strip
  std::vector<simd::GasRow> gas_rows_;                                         // empty: no attenuation by gases
  PolarArray<float> arc_;                                                      // by column, as in simd::Strip
  PolarArray<float> cross_section_m2_;                                         // by PolarGrid::at()
};

}  // namespace yars::model::hrm
