// Sampling of cells: interpolation at one position, resampling, and the view over many cells.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

// Interpolation inside one cell, in double, at one place: the truth that the fast look-up is held against. Coordinates
// are degrees from the cell's south-west corner, [0, 1], clamped. Voids among the posts are left out and the other
// weights scaled up; what the kernel of the cubic reaches beyond the cell's edge repeats the edge.

// Bilinear between four posts; nearest: the nearest of them; cubic: Catmull-Rom over sixteen, bilinear where one of
// those is void. Water is the share of posts at 0 m by the bilinear (nearest) weights.
Surface interpolate(const Cell& cell, double north_deg, double east_deg,
                    radar::Interpolation interpolation = radar::Interpolation::bilinear);

// A cell on another grid of the same degree: box means as long as the old intervals are a multiple of the new ones
// (as reduce_by), bilinear else. Both keep edges equal for neighbours whose edges are equal. Sea and voids as in
// cell.hpp, and the unit stays: at exactly 0 m only where more than half is sea; void only where all posts taken are.
// Requires rows, columns >= 2.
Cell resample(const Cell& cell, int rows, int columns);

// What stands in a cell's slot where no cell is in memory.
enum class Absence : std::uint8_t {
  sea,         // 0 m, water
  none,        // void: no file, or one that cannot be read
  not_loaded,  // a file exists but the view was made without it
};

// What stands for one cell: its heights, at a coarser level the highest ground about each post, and what covers it.
struct TerrainCell {
  std::shared_ptr<const Cell> heights;
  std::shared_ptr<const Cell> peaks;       // null: the heights themselves
  std::shared_ptr<const Culture> culture;  // null: none given
};

// A view over a set of cells: what DirectoryTerrainStore hands out. Lookup is a table over all cells of the earth.
// surfaces() goes by runs of places in one cell; its result at a place does not depend on the others.
class CellView final : public TerrainView {
 public:
  // `elsewhere` holds where neither set_absence nor add says otherwise.
  CellView(std::uint64_t generation, Absence elsewhere, int detail = 0);

  // While building; afterwards the view is shared as const.
  void set_absence(CellPlace place, Absence absence);
  void add(std::shared_ptr<const Cell> cell) { add(TerrainCell{std::move(cell), nullptr, nullptr}); }
  void add(TerrainCell cell);

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return sizeof(*this) + resident_bytes_; }
  Surface surface_at(geo::GeoPoint place, Interpolation interpolation) const override;
  bool serves(int detail) const override { return detail == detail_; }
  bool has_peaks() const override { return has_peaks_; }
  double post_spacing_m() const override { return post_spacing_m_; }
  PostSpacing post_spacing_at(geo::GeoPoint place) const override;
  std::vector<std::shared_ptr<const Cell>> cells_within(const GeoBox& box) const override;
  bool has_materials() const override { return has_materials_; }
  std::size_t surfaces(const PlaceRun& places, Interpolation interpolation, const SurfaceRun& found) const override;
  bool crests(const PlaceRun& places, const RaySight& sight, std::span<float> tangent) const override;

 private:
  static constexpr std::uint16_t kFirstCell = 3;  // entries below are Absence values, from here on cells_

  // The next places that one entry of the table serves; at least one.
  struct Run {
    std::uint16_t what = static_cast<std::uint16_t>(Absence::none);
    std::size_t first = 0, places = 1;
    bool beyond_pole = false;
  };
  Run run_at(const PlaceRun& places, std::size_t first) const;
  void raise_first_crest(const PlaceRun& places, const RaySight& sight, float& tangent) const;
  void look_up_run(const Run& run, const PlaceRun& places, Interpolation interpolation, const SurfaceRun& found) const;
  void look_up_singly(const Run& run, const PlaceRun& places, Interpolation interpolation,
                      const SurfaceRun& found) const;

  std::uint16_t entry(CellPlace place) const { return table_[slot_of(place)]; }

  std::uint64_t generation_;
  int detail_;
  std::uint64_t resident_bytes_ = 0;
  double post_spacing_m_ = 0.0;
  bool has_peaks_ = false;
  bool has_materials_ = false;
  std::vector<TerrainCell> cells_;
  std::array<std::uint16_t, static_cast<std::size_t>(kCellRows) * kCellColumns> table_;
};

}  // namespace yars::model::terrain
