// Labels of the pixels of a patch map: what the radar sees there. Shadow, layover, object, material, height, grazing.
// Inputs: surface of ground and scene on the polar grid with its surface labels; the rows that each grid cell shows, by
// cast_profile() (profile_simd.hpp). Outputs: one array per label, by MapImage::at().
// A pixel has the label of the grid cell that is nearest to its centre. A cell shows the surface with the strongest
// return. Impulse response, speckle, noise and point targets change no label.
// Units: metres above mean sea level; sine of the grazing angle.
// Threads: draw() of disjoint rows may run at the same time.
// Source: docs/python.md, "Labels".
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/modes.hpp"
#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm {

struct MapImage;

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
  void begin(std::size_t points);

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
  void set_pixel(std::size_t pixel, const PolarGrid& grid, std::size_t cell);
  void set_heights(std::size_t pixel, const PatchGeometry& geometry, const PolarGrid& grid, const SurfacePoint* surface,
                   std::size_t cell);

  int size_;
  LabelUse use_;
  PixelLabels pixels_;
  // By PolarGrid::at(). The arrays never shrink.
  memory::CacheAlignedVector<std::uint32_t> surface_;   // surface label of each grid point
  memory::CacheAlignedVector<std::int32_t> shown_row_;  // row of the grid point that the cell shows
  memory::CacheAlignedVector<std::int32_t> layers_;     // number of visible surfaces at the cell's slant range
  memory::CacheAlignedVector<float> strength_;          // greatest return of one surface; 0: shadow
};

}  // namespace yars::model::hrm
