// A view over a set of cells: what DirectoryTerrainStore hands out. Lookup is a table over all cells of the earth.
// surfaces() goes by runs of places in one cell; its result at a place does not depend on the others.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "model/terrain/cell.hpp"
#include "model/terrain/culture.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

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
