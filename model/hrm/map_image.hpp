// Picture of a patch map: power on the map, speckle, thermal noise, video.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/clutter.hpp"

namespace yars::model::hrm {

// From what returns to a picture: the fan drawn onto the map, the impulse response, moving targets, speckle, receiver
// noise and the logarithm. Power is counted as the gamma that level ground at the centre would need to return as much.

// Square, row 0 at the far edge.
struct MapImage {
  explicit MapImage(int edge) : size(edge), power(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge)) {}
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
  }

  int size;
  memory::LineVector<float> power;
  bool blind = false;  // part of it is blank
};

// Level ground of gamma 1 returns this [m^2] a pixel: what a cross section is divided by.
double unit_return_m2(const PatchGeometry& geometry, int pixels);

// Rows [first, last) of the map from a fan of cross sections, bilinear. Blind cells become -1.
void draw_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const float* cross_section_m2, int first,
                     int last, MapImage& image);

// Marks what lies in the blind zone with -1, after all that returns is drawn.
void blank_blind_zone(const PatchGeometry& geometry, geo::Bearing ground_track,
                      const radar::HighResolutionConfiguration& configuration, MapImage& image);

// Speckle of a map: it is correlated over the resolution cells, kCellsOfMap an edge, not over the pixels. Each look is
// a field of circular complex Gaussian numbers, one a cell, and the intensity is the mean of their squares: mean 1 and
// variance 1 / looks at every pixel. Where pixels are finer than cells the field is interpolated, its weights scaled
// to unit energy, so that the statistics hold between the cells too.
// Source: Goodman, "Statistical properties of laser speckle patterns" (1975); docs/spec/physics.md#speckle.
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

// Speckle, thermal noise and the receiver's logarithm: from power to the picture.

// Thermal noise as the gamma of level ground that returns as much: it falls behind with the cube of the slant range,
// for the time that a map takes makes up for one power of the fourth; and it is less the coarser the cells of a window
// are, for each holds more ground. Source: Carrara, Goodman, Majewski, "Spotlight SAR", 3.1 (noise-equivalent sigma
// nought).
double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range,
                   geo::Length window);

struct MapNoise {
  double thermal = 0.0;   // as noise_gamma() has it
  int looks = 1;          // of the speckle
  std::uint32_t map = 0;  // names the noise, together with the seed
};

// Rows [first, last) of the picture, which is as large as the image. Blank pixels are black.
void form_video(const radar::RadarConfiguration& configuration, const MapImage& image, const MapNoise& noise, int first,
                int last, std::vector<std::uint8_t>& picture);

}  // namespace yars::model::hrm
