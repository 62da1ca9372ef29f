// A view over a set of cells: what DirectoryTerrainStore hands out. Lookup is a table over all cells of the earth.
// elevations() is plain C++ over runs of places in one cell; its result at a place does not depend on the others.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/terrain/cell.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

// What stands in a cell's slot where no cell is in memory.
enum class Absence : std::uint8_t {
  sea,         // 0 m, water
  none,        // void: no file, or one that cannot be read
  not_loaded,  // a file exists but the view was made without it
};

class CellView final : public TerrainView {
 public:
  // `elsewhere` holds where neither set_absence nor add says otherwise.
  CellView(std::uint64_t generation, Absence elsewhere);

  // While building; afterwards the view is shared as const.
  void set_absence(CellPlace place, Absence absence);
  void add(std::shared_ptr<const Cell> cell);

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return sizeof(*this) + resident_bytes_; }
  Surface surface_at(geo::GeoPoint place) const override;
  std::size_t elevations(std::span<const double> latitude_deg, std::span<const double> longitude_deg,
                         std::span<float> elevation_m, std::span<float> water) const override;

 private:
  static constexpr std::uint16_t kFirstCell = 3;  // entries below are Absence values, from here on cells_

  // The first places that one entry of the table serves; at least one.
  struct Run {
    std::uint16_t what = static_cast<std::uint16_t>(Absence::none);
    std::size_t places = 1;
    double shift_deg = 0.0;  // added to each longitude
  };
  Run run_at(std::span<const double> latitude_deg, std::span<const double> longitude_deg) const;

  std::uint16_t entry(CellPlace place) const { return table_[slot_of(place)]; }

  std::uint64_t generation_;
  std::uint64_t resident_bytes_ = 0;
  std::vector<std::shared_ptr<const Cell>> cells_;
  std::array<std::uint16_t, static_cast<std::size_t>(kCellRows) * kCellColumns> table_;
};

}  // namespace yars::model::terrain
