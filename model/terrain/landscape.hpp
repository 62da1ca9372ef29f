// A made-up earth: coasts with bays, capes and islands, a plain, ranges in chains along the coast with valleys
// between. Height is a function of place and seed alone, so cells made one by one meet without a seam.
// Below `kLatticePerDegree` detail it is a cubic spline over a lattice of the broad shapes, then gullies.
#pragma once

#include <cstdint>

#include "model/terrain/cell.hpp"
#include "model/terrain/gullies.hpp"

namespace yars::model::terrain {

class Landscape {
 public:
  explicit Landscape(std::uint64_t seed);

  // The cell at `rows` x `columns` posts (rows - 1 and columns - 1 divide 3600). Sea is 0 m, land at least 1 m.
  Cell cell(CellPlace place, int rows, int columns) const;

  // Height of the broad shapes [m], negative under the sea, before gullies.
  double broad_height_m(geo::GeoPoint place) const;

 private:
  std::uint32_t seed_;
  Gullies gullies_;
};

}  // namespace yars::model::terrain
