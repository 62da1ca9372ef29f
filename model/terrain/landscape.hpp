// A made-up earth: coasts with bays, capes and islands, a plain, ranges in chains along the coast with valleys
// between. Height is a function of place and seed alone, so cells made one by one meet without a seam: broad shapes
// from noise on the sphere, sampled on a lattice of 30 arc seconds, there cut by the larger valleys, joined by a
// cubic spline, and cut again post by post by the small gullies. Not for navigation.
#pragma once

#include <cstdint>

#include "model/terrain/cell.hpp"
#include "model/terrain/gullies.hpp"

namespace yars::model::terrain {

// The region that scripts/start flies in; config/routes/default.route goes along its coast.
struct DefaultLandscape {
  static constexpr int kSouthDeg = 36, kWestDeg = -124;
  static constexpr int kCellsNorth = 4, kCellsEast = 4;
  static constexpr std::uint64_t kSeed = 12;
};

class Landscape {
 public:
  explicit Landscape(std::uint64_t seed);

  // The cell at `rows` x `columns` posts (rows - 1 and columns - 1 divide 3600). Sea is 0 m, land at least 1 m.
  Cell cell(CellPlace place, int rows, int columns) const;

  // Height of the broad shapes [m], negative under the sea, before valleys and gullies.
  double broad_height_m(geo::GeoPoint place) const;

 private:
  std::uint32_t seed_;
  Gullies valleys_;
  Gullies gullies_;
};

}  // namespace yars::model::terrain
