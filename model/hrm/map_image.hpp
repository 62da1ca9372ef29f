// Picture of a patch map: power per pixel, blind zone, speckle, thermal noise, video.
// Frame: square, row 0 at the far edge, columns from left to right of the line of sight.
// Units: power as gamma, namely the gamma of level ground at the centre with the same return.
// Outputs: 8-bit video, 0 black to 255 white.
// Source: docs/radar_maths.md, "Patch maps".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/clutter.hpp"

namespace yars::radar {
struct HighResolutionConfiguration;
}  // namespace yars::radar

namespace yars::model::hrm {

// Power of a patch map by pixel; -1 marks a blind pixel.
struct MapImage {
  explicit MapImage(int edge) : size(edge), power(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge)) {}
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
  }

  int size;
  memory::CacheAlignedVector<float> power;
  bool blind = false;  // some pixels are blind
};

// Cross section [m^2] of a pixel of level ground with gamma 1 at the centre: the divisor of power in MapImage.
double unit_return_m2(const PatchGeometry& geometry, int pixels);

// Interpolates rows [first, last) of the map bilinearly from cross sections on the polar grid.
void draw_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const float* cross_section_m2, int first,
                     int last, MapImage& image);

// Sets pixels in the blind zone to -1. Call it after all power is added.
void blank_blind_zone(const PatchGeometry& geometry, geo::Bearing ground_track,
                      const radar::HighResolutionConfiguration& configuration, MapImage& image);

// Speckle of one map, correlated over the resolution cells (kMapCells a side), not over the pixels. Each look is a
// field of circular complex Gaussian numbers, one a cell. The intensity is the mean of their squares: mean 1, variance
// 1 / looks at every pixel. Pixels finer than cells are interpolated with weights of unit energy, so the statistics
// hold between cells too.
// Source: Goodman, "Statistical properties of laser speckle patterns" (1975); docs/spec/physics.md#speckle.
class Speckle {
 public:
  // `size`: pixels a side; `looks` in [1, 16]. `seed` and `map` are the key of the noise.
  Speckle(int size, int looks, std::uint64_t seed, std::uint32_t map);

  // Speckle factors of one row of pixels, padded at the end. Rows must ascend. Valid until the next call.
  const float* row(int row);

 private:
  // Interpolation of a pixel between two cells: index of the first, weights of both.
  struct CellWeights {
    std::int32_t cell;
    float first, second;
  };
  CellWeights cell_weights(int pixel) const;
  void draw_cells(int cell_row, std::vector<float>& field);

  int size_, looks_;
  std::uint64_t seed_;
  std::uint32_t map_;
  bool finer_;  // pixels are smaller than cells
  std::size_t pitch_;
  std::vector<std::int32_t> cell_;     // first cell of each pixel of a row
  std::vector<float> first_, second_;  // weights of both cells
  std::vector<float> cells_;           // one row of cells: real parts, then imaginary parts
  std::vector<float> near_, far_;  // two rows of cells interpolated to the row's pixels: by look, real and imaginary
  int drawn_row_ = -2;             // row of cells in far_
  std::vector<float> intensity_;
};

// Thermal noise as the gamma of level ground with the same return. It rises with the cube of the slant range, because
// the longer formation time offsets one power of the fourth. It falls with the window, because larger cells hold more
// ground.
// Source: Carrara, Goodman, Majewski, "Spotlight SAR", 3.1 (noise-equivalent sigma nought).
double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range,
                   geo::Length window);

struct MapNoise {
  double thermal = 0.0;    // from noise_gamma()
  int looks = 1;           // of the speckle
  std::uint32_t map = 0;   // number of the map; with the seed the key of the noise
  std::uint64_t seed = 1;  // of all noise
  bool with_speckle = true;
};

// Forms video of rows [first, last). `picture` has the size of the image. Blind pixels are black.
void form_video(const radar::HighResolutionConfiguration& hrm, const MapImage& image, const MapNoise& noise, int first,
                int last, std::vector<std::uint8_t>& picture);

}  // namespace yars::model::hrm
