// Speckle of a map: it is correlated over the resolution cells, kCellsOfMap an edge, not over the pixels. Each look is
// a field of circular complex Gaussian numbers, one a cell, and the intensity is the mean of their squares: mean 1 and
// variance 1 / looks at every pixel. Where pixels are finer than cells the field is interpolated, its weights scaled
// to unit energy, so that the statistics hold between the cells too.
// Source: Goodman, "Statistical properties of laser speckle patterns" (1975); docs/spec/physics.md#speckle.
#pragma once

#include <cstdint>
#include <vector>

#include "model/rbm/noise.hpp"

namespace yars::model::hrm {

class Speckle {
 public:
  // A map `size` pixels on an edge; `looks` in [1, 16]. Seed and map name the noise.
  Speckle(int size, int looks, std::uint64_t seed, std::uint32_t map);

  // Factors on the power of a row of pixels, some more behind the last; rows ascend. Valid until the next call.
  const float* row(int row);

 private:
  // Where a pixel lies among the cells: the first of two, and what each of them weighs.
  struct Between {
    std::int32_t cell;
    float first, second;
  };
  Between between(int pixel) const;
  void draw_cells(int cell_row, std::vector<float>& field);

  int size_, looks_;
  std::uint64_t seed_;
  std::uint32_t map_;
  bool finer_;  // pixels than cells
  std::size_t pitch_;
  std::vector<std::int32_t> cell_;     // of each pixel of a row
  std::vector<float> first_, second_;  // weights
  std::vector<float> cells_;           // a row of cells, real and imaginary
  std::vector<float> near_, far_;      // two rows of cells on the row's pixels, by look, real and imaginary
  int drawn_ = -2;                     // row of cells in far_
  std::vector<float> intensity_;
};

}  // namespace yars::model::hrm
