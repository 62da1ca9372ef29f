// Picture of a patch map: power per pixel, blind zone, speckle, thermal noise, video. Labels of its pixels: what the
// radar sees there (shadow, layover, object, material, height, grazing).
// A pixel has the label of the grid cell that is nearest to its centre. A cell shows the surface with the strongest
// return. Impulse response, speckle, noise and point targets change no label. Threads may draw disjoint rows of labels.
// Inputs of labels: surface of ground and scene on the polar grid with its surface labels; the rows that each grid cell
// shows, by cast_profile() (profile_simd.hpp). Outputs: 8-bit video, 0 black to 255 white; an array per label, by at().
// Frame: square, row 0 at the far edge, column 0 at the left edge as seen from the aircraft.
// Units: power is a gamma (sigma0 = gamma * sin(grazing angle)). Level ground of this gamma at the map's centre would
// return as much as the pixel. Labels: metres above mean sea level; sine of the grazing angle.
// Source: docs/radar_maths.md, "Patch maps"; docs/python.md, "Labels".
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/modes.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/physics/clutter.hpp"

namespace yars::radar {
struct HighResolutionConfiguration;
}  // namespace yars::radar

namespace yars::model::hrm {

// Power of a patch map by pixel. -1 marks a blind pixel: a pixel in the blind zone.
struct MapImage {
  explicit MapImage(int edge) : size(edge), power(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge)) {}
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
  }

  int size;
  memory::CacheAlignedVector<float> power;
  bool blind = false;  // true if any pixel is blind
  // What of `power` comes from point targets, by ascending pixel number, which may occur several times.
  std::vector<physics::SteadyPower> steady;
};

// Cross section [m^2] of a pixel of level ground with gamma 1 at the map's centre. MapImage::power is the cross section
// of a pixel divided by this value. `pixels`: number of pixels per side.
double unit_return_m2(const PatchGeometry& geometry, int pixels);

// Interpolates rows [first, last) of the map bilinearly from cross sections on the polar grid, in the pixels that the
// sector draws.
void draw_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const float* cross_section_m2, int first,
                     int last, MapImage& image);

// Blind zone on a patch map: two opposite sectors about the ground track, ahead and astern, with their apex at the
// aircraft's position over ground.
// Method: the zone's edges are two lines through the apex. A pixel is blind where the product of its cross products
// with both lines is negative. In a row of pixels this holds for whole runs, so only pixels within rounding of an edge
// are tested, by their angle. Accuracy: the same pixels as with radar::in_blind_zone() at every pixel.
class BlindZone {
 public:
  // `half_width_deg`: [deg] either side of the ground track. `size`: number of pixels per side of the map.
  BlindZone(const PatchGeometry& geometry, geo::Bearing ground_track, double half_width_deg, int size);

  // False if no pixel of the map is blind. True says nothing.
  bool may_reach_map() const;
  // Sets blind pixels of rows [first, last) to -1. Returns true if there are any. Call it after all power is added.
  bool blank(int first, int last, MapImage& image) const;

 private:
  // An edge: the line through the apex at the angle `sine`, `cosine` from the map's up direction.
  struct Edge {
    double sine, cosine;
    double columns_per_m;  // columns that the edge moves per metre ahead of the apex
    double doubt_columns;  // pixels nearer than this to the edge are tested by angle
  };
  // Columns [first, last) of a row.
  struct Run {
    int first, last;
  };
  double ahead_m(int row) const { return distance_m_ + edge_m_ - (row + 0.5) * pixel_m_; }
  double right_m(int column) const { return (column + 0.5) * pixel_m_ - edge_m_; }
  bool blank_row(double ahead_m, float* power) const;
  bool blank_run(Run run, double ahead_m, float* power) const;
  bool blank_by_angle(Run run, double ahead_m, float* power) const;
  Run doubtful(const Edge& edge, double ahead_m) const;

  double half_width_deg_;
  geo::Angle squint_;  // of the map's centre
  int size_;
  double distance_m_;  // from the apex to the map's centre
  double edge_m_;      // half of the window
  double pixel_m_;
  std::array<Edge, 2> edges_{};
};

// Speckle of one map. Each look is a field of circular complex Gaussian numbers. The intensity is the mean of the
// squared magnitudes of all looks. It has mean 1 and variance 1 / looks at every pixel.
// Pixels finer than resolution cells (kMapCells per side): one number per cell and look, interpolated to pixels. The
// squares of the weights sum to 1, which keeps mean and variance. Other pixels: one independent intensity per pixel.
// Source: Goodman, "Statistical properties of laser speckle patterns" (1975); docs/spec/physics.md#speckle.
class Speckle {
 public:
  // `size`: pixels per side; `looks` in [1, 16]. `seed` and `map` (number of the map) select the speckle.
  Speckle(int size, int looks, std::uint64_t seed, std::uint32_t map);

  // Returns the speckle factors of one row of pixels, valid until the next call. Call it with ascending rows.
  const float* row(int row);

 private:
  // Interpolation of a pixel between two neighbouring cells: index of the first cell in cells_, weights of both cells.
  struct CellWeights {
    std::int32_t cell;
    float first, second;
  };
  CellWeights cell_weights(int pixel) const;
  void draw_cells(int cell_row, std::vector<float>& field);

  int size_, looks_;
  std::uint64_t seed_;
  std::uint32_t map_;
  bool finer_;  // pixels are smaller than resolution cells
  std::size_t pitch_;
  // CellWeights of each pixel of a row, as arrays.
  std::vector<std::int32_t> cell_;
  std::vector<float> first_, second_;
  std::vector<float> cells_;  // one row of cells: real parts, then imaginary parts
  // Two rows of cells, interpolated to pixels: the earlier one (near_) and the next (far_). By look: real, imaginary.
  std::vector<float> near_, far_;
  int drawn_row_ = -2;  // row of cells in far_; -2: none
  std::vector<float> intensity_;
};

// Thermal noise, expressed as the gamma of level ground with an equal return. It rises with the cube of the slant
// range: the radar equation has the fourth power, and the formation time, proportional to range, offsets one power.
// Thermal noise is inversely proportional to the side of the window.
// Source: Carrara, Goodman, Majewski, "Spotlight SAR", 3.1 (noise-equivalent sigma nought).
double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range,
                   geo::Length window);

// Speckle and thermal noise of one map.
struct MapNoise {
  double thermal = 0.0;    // gamma of thermal noise, from noise_gamma()
  int looks = 1;           // number of independent looks
  std::uint32_t map = 0;   // number of the map; equal seed and number give equal speckle
  std::uint64_t seed = 1;  // from the configuration
  bool with_speckle = true;
};

// Forms video of rows [first, last). `picture` has the size of the image. Blind pixels are black.
void form_video(const radar::HighResolutionConfiguration& hrm, const MapImage& image, const MapNoise& noise, int first,
                int last, std::vector<std::uint8_t>& picture);

// Surface label: material code of DFAD and scene object of a surface in one number. The upper 5 bits are the code, the
// lower 27 bits 1 + the index into SceneView::objects(), or 0 for ground without scene.
inline constexpr unsigned kLabelObjectBits = 27;
inline constexpr std::uint32_t kLabelObjects = (1U << kLabelObjectBits) - 1U;
constexpr std::uint32_t ground_label(std::uint8_t material) {
  return static_cast<std::uint32_t>(material % radar::kMaterials) << kLabelObjectBits;
}
constexpr std::uint32_t surface_label(std::uint8_t material, std::uint32_t object) {
  return ground_label(material) | std::min(object + 1U, kLabelObjects);
}
// Index of the object; -1: ground.
constexpr std::int32_t object_of(std::uint32_t label) {
  return static_cast<std::int32_t>(label & kLabelObjects) - 1;
}
constexpr std::uint8_t material_of(std::uint32_t label) {
  return static_cast<std::uint8_t>(label >> kLabelObjectBits);
}

// Labels to compute. `surfaces`: shadow, layover, object, material. `heights`: height and grazing angle, too.
enum class LabelUse : std::uint8_t { none, surfaces, heights };

// Labels by pixel. In the blind zone there is no label: no shadow, no layover, object -1, material 0, NaN.
struct PixelLabels {
  std::vector<std::uint8_t> shadow;    // 1: no surface that the radar sees returns here
  std::vector<std::uint8_t> layover;   // 1: two or more separate surfaces that the radar sees have this slant range
  std::vector<std::int32_t> object;    // index into SceneView::objects(); -1: ground, or shadow
  std::vector<std::uint8_t> material;  // code of DFAD; 0: land without culture, or shadow
  std::vector<float> height_m;         // [m MSL]; NaN in shadow
  std::vector<float> sin_grazing;      // on the profile of the line of sight; NaN in shadow
};

// Labels of one map: of the grid cells of the current sector, and of the pixels.
class MapLabels {
 public:
  MapLabels(int size, LabelUse use) : size_(size), use_(use) {}

  bool wanted() const { return use_ != LabelUse::none; }
  // Call before each map. `points`: entries of the arrays of the largest sector.
  void begin(const PatchGeometry& geometry, const PolarGrid& grid, std::size_t points);

  // Arrays by PolarGrid::at(); null if no labels are wanted.
  std::uint32_t* surface_labels() { return wanted() ? surface_.data() : nullptr; }
  std::int32_t* shown_rows() { return wanted() ? shown_row_.data() : nullptr; }
  std::int32_t* layers() { return wanted() ? layers_.data() : nullptr; }
  float* strength() { return wanted() ? strength_.data() : nullptr; }

  // Sets the pixels of rows [first, last) that the sector draws. `surface`: as drawn by PolarScene.
  void draw(const PatchGeometry& geometry, const PolarGrid& grid, const SurfacePoint* surface, int first, int last);
  // Removes the labels of blind pixels. Call it after the blind zone of the image is blank.
  void clear_blind(const MapImage& image);

  const PixelLabels& pixels() const { return pixels_; }
  PixelLabels take() { return std::move(pixels_); }  // the next map makes new arrays

 private:
  void set_pixel(std::size_t pixel, std::size_t top, std::size_t cell);
  void set_heights(std::size_t pixel, const PatchGeometry& geometry, const PolarGrid& grid, const SurfacePoint* column,
                   std::int32_t row);

  int size_;
  LabelUse use_;
  PixelLabels pixels_;
  std::vector<double> above_plane_m_;  // PatchGeometry::above_plane_m(), by row
  // By PolarGrid::at(). The arrays never shrink.
  memory::CacheAlignedVector<std::uint32_t> surface_;   // surface label of each grid point
  memory::CacheAlignedVector<std::int32_t> shown_row_;  // row of the grid point that the cell shows
  memory::CacheAlignedVector<std::int32_t> layers_;     // number of visible surfaces at the cell's slant range
  memory::CacheAlignedVector<float> strength_;          // greatest return of one surface; 0: shadow
};

}  // namespace yars::model::hrm
