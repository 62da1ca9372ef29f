// Made-up texture of the ground below the spacing of posts: what fields, tracks and stones make of a patch that would
// else show the facets of the terrain. A factor on gamma, mean 1, that stays where it is on the earth: the same from
// every direction and in every look. Two samples of one periodic table, turned and stretched against each other, so
// that no period shows; coarser pixels read a table whose cells are averaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

class Detail {
 public:
  // `contrast`: standard deviation of the factor; `pixel_m`: what the samples stand for.
  Detail(double contrast, double pixel_m);

  double pixel_m() const { return pixel_m_; }
  double texel_m() const { return 1.0 / static_cast<double>(texels_per_metre_); }  // half its shortest wave
  // gain[i] *= factor at the place; terrain::kRunSlack entries behind the last may be overwritten.
  void modulate(const terrain::PlaceRun& places, float* gain) const;

 private:
  void pack(const std::vector<float>& texels);

  double pixel_m_;
  float texels_per_metre_;
  int edge_;           // texels, a power of two
  float unit_ = 1.0F;  // what one step of a byte is worth
  // As simd::DetailTable has them: a byte each of the texel itself, the one to its right, and the two above them, so
  // that what lies between the four is one look.
  std::vector<std::uint32_t> table_;
};

}  // namespace yars::model::hrm
