// Synthetic texture of the ground's reflectivity: features that terrain posts do not resolve (fields, paths, stones).
// Inputs: positions on the earth. Output: a factor on gamma (sigma0 = gamma * sin(grazing angle)) with mean 1.
// The factor depends only on the position, so it is equal from every direction and in every look.
// The texture has no period: it blends tiles at random offsets into one table (simd::modulate()). It has a seam at
// whole degrees. A texel (element of the table) is 4 m wide, or wider if positions are more than 8 m apart. Source:
// docs/spec/physics.md#multi-look.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::hrm {

// Texture of the ground for positions of one spacing, and of others with texels of the same width.
class GroundTexture {
 public:
  // `contrast`: standard deviation of the natural logarithm of the factor. `pixel_m`: spacing of the positions.
  GroundTexture(double contrast, double pixel_m);

  // True if a texture for this spacing of positions is the same as this one.
  bool fits(double pixel_m) const;
  double texel_m() const { return 1.0 / static_cast<double>(texels_per_metre_); }  // half the wave of the finest octave
  // gamma[i] *= factor at position i. Up to terrain::kRunSlack entries beyond the last one are read and written.
  void modulate(const terrain::PositionRun& positions, float* gamma) const;

 private:
  void fill_table(const std::vector<float>& field);

  float texels_per_metre_ = 0.0F;
  int edge_;             // texels per side of the table, a power of two
  double mean_ = 0.0;    // of the field, the fourth root of the factor
  double lowest_ = 0.0;  // value of the byte 0 in table_
  double step_ = 0.0;    // difference in value per step of a byte
  // Words as in simd::DetailTable: a texel and its neighbours to the east, north and north-east, one byte each. So one
  // gather (vector load with one address per lane) reads the four texels of each bilinear sample.
  std::vector<std::uint32_t> table_;
};

}  // namespace yars::model::hrm
