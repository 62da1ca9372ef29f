// A made-up earth: coasts, ranges, rivers that run to the sea in valleys of their own, towns, airfields, woods.
// Height and cover are functions of place and seed alone (and of the box, for an island), so cells made one by one
// meet without a seam, and a post has one height whatever the spacing of the cell it is in. Not for navigation.
// Broad shapes hang on a lattice of 30 arc seconds (landscape_tiles.hpp), joined by a cubic spline and cut post by
// post by gullies down to some 100 m. Safe for any number of threads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "model/terrain/cell.hpp"
#include "model/terrain/culture.hpp"
#include "model/terrain/landscape_box.hpp"
#include "model/terrain/landscape_tiles.hpp"

namespace yars::model::terrain {

// The region that scripts/start flies in; config/routes/default.route goes along its coast.
struct DefaultLandscape {
  static constexpr int kSouthDeg = 36, kWestDeg = -124;
  static constexpr int kCellsNorth = 4, kCellsEast = 4;
  static constexpr std::uint64_t kSeed = 12;
};

struct MadeCell {
  Cell cell;
  Culture culture;  // at the cell's posts
};

class Landscape {
 public:
  // With an island's box, land falls to the sea before the box's edge.
  explicit Landscape(std::uint64_t seed, std::optional<LandscapeBox> island = std::nullopt);

  // The cell at `rows` x `columns` posts (rows - 1 and columns - 1 divide 3600). Sea is 0 m, land at least 1 m;
  // a river's water may be at 0 m near its mouth. The bits do not depend on `threads` (at least 1).
  MadeCell make(CellPlace place, int rows, int columns, int threads = 1) const;
  Cell cell(CellPlace place, int rows, int columns) const { return make(place, rows, columns).cell; }

  // Rivers, towns and airfields of one degree by one degree.
  std::shared_ptr<const TileFeatures> features(CellPlace place) const { return tiles_->features(place); }
  std::shared_ptr<const ReliefTile> relief(CellPlace place) const { return tiles_->relief(place); }

  // False when no post of the cell can be land; may say true of a cell that is all sea.
  bool may_have_land(CellPlace place) const;

 private:
  std::uint32_t seed_;
  std::unique_ptr<LandscapeTiles> tiles_;
};

}  // namespace yars::model::terrain
