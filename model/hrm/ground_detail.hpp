// Synthetic texture of the ground below the post spacing, for example fields, tracks and stones.
// Inputs: positions on the earth. Output: a factor on gamma with mean 1.
// The factor depends on the position alone, so it is the same from every direction and in every look.
// It is the product of two samples of one periodic texture, turned and stretched against each other to hide the period.
// Coarser pixels use a texture with larger texels.
// Source: docs/spec/physics.md#multi-look.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

class Detail {
 public:
  // `contrast`: standard deviation of the natural logarithm of the factor. `pixel_m`: spacing of the samples.
  Detail(double contrast, double pixel_m);

  double pixel_m() const { return pixel_m_; }
  double texel_m() const { return 1.0 / static_cast<double>(texels_per_metre_); }  // half the texture's shortest wave
  // gain[i] *= factor at position i. Up to terrain::kRunSlack entries beyond the last may be read and written.
  void modulate(const terrain::PositionRun& positions, float* gain) const;

 private:
  void pack(const std::vector<float>& texels);

  double pixel_m_;
  float texels_per_metre_;
  int edge_;           // texels, a power of two
  float unit_ = 1.0F;  // value of one byte step
  // Layout of simd::DetailTable: a word holds a texel and its neighbours right, above and above right. One gather gives
  // a bilinear sample.
  std::vector<std::uint32_t> table_;
};

}  // namespace yars::model::hrm
