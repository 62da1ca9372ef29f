// Where one-degree cells lie on the earth.
#pragma once

#include <cstddef>

#include "lib/geo/geodesic.hpp"

namespace yars::model::terrain {

inline constexpr int kCellRows = 180;     // cells from pole to pole
inline constexpr int kCellColumns = 360;  // cells round the earth

// Named by the south-west corner: whole degrees, south [-90, 89], west [-180, 179].
struct CellPlace {
  int south_deg = 0;
  int west_deg = 0;
  friend bool operator==(CellPlace, CellPlace) = default;
};

// Position in a table of kCellRows x kCellColumns cells, and back.
constexpr std::size_t slot_of(CellPlace place) {
  return static_cast<std::size_t>(place.south_deg + 90) * kCellColumns + static_cast<std::size_t>(place.west_deg + 180);
}
constexpr CellPlace place_of_slot(std::size_t slot) {
  return {static_cast<int>(slot / kCellColumns) - 90, static_cast<int>(slot % kCellColumns) - 180};
}

// The cell that holds a point: longitude wrapped, latitude clamped; a point on a shared edge belongs to the cell
// north or east of it. Coordinates must be finite.
CellPlace cell_holding(geo::GeoPoint point);

}  // namespace yars::model::terrain
