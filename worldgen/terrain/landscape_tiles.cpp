#include "worldgen/terrain/landscape_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/random/counter_rng.hpp"

namespace yars::worldgen {

namespace {

constexpr int kTownRanks = 26;             // attempted towns per tile at the equator
constexpr int kSites = 24;                 // candidate sites per town
constexpr double kSmallestTown_m = 450.0;  // radius
constexpr int kAirfields = 3;              // attempted airfields per tile
constexpr int kAirfieldSites = 30;         // candidate sites per airfield
constexpr double kPadUneven_m = 30.0;      // maximum height difference on ground that is levelled for an airfield
constexpr int kEdgeMargin = 6;             // [nodes] minimum distance of sites from the tile's edge

class SettlementMaker {
 public:
  SettlementMaker(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed)
      : relief_(relief), seed_(seed), river_km2_(static_cast<std::size_t>(kTileNodes) * kTileNodes) {
    for (const RiverNode& node : drainage.nodes) river(node.row, node.column) = static_cast<float>(node.area_km2);
    parallel_ = std::max(0.05, std::cos((relief.corner().south_deg + 0.5) * geo::kRadiansPerDegree));
  }

  Settlements make() {
    const double largest_m = std::min(kMaxTownRadius_m, 1500.0 / std::sqrt(0.04 + random_fraction()));
    const int ranks = static_cast<int>(kTownRanks * parallel_);
    for (int rank = 1; rank <= ranks; ++rank) {
      const double radius_m = largest_m / std::sqrt(static_cast<double>(rank));
      add_town(std::max(radius_m, kSmallestTown_m));
    }
    for (int airfield = 0; airfield < kAirfields; ++airfield) add_airfield();
    return std::move(settlements_);
  }

 private:
  float& river(int row, int column) {
    return river_km2_[static_cast<std::size_t>(row) * kTileNodes + static_cast<std::size_t>(column)];
  }
  double random_fraction() {
    ++draws_;
    return random::unit_fraction(
        random::lattice_hash(relief_.corner().west_deg, relief_.corner().south_deg, draws_, seed_));
  }
  TileNode any_node() {
    const double span = kTileNodes - 2 * kEdgeMargin;
    const int row = kEdgeMargin + static_cast<int>(span * random_fraction());
    return {row, kEdgeMargin + static_cast<int>(span * random_fraction())};
  }
  double distance_m(TileNode a, TileNode b) const {
    const double east_m = (a.column - b.column) * kNodeMetres * parallel_;
    const double north_m = (a.row - b.row) * kNodeMetres;
    return std::sqrt(east_m * east_m + north_m * north_m);
  }

  // Score of a site for a town: low ground, sea, rivers and river mouths raise it. nullopt: no town can be there.
  std::optional<double> suitability(TileNode at) {
    double lowest_m = 1e9;
    double river_km2 = 0.0;
    for (int row = at.row - 3; row <= at.row + 3; ++row)
      for (int column = at.column - 3; column <= at.column + 3; ++column) {
        lowest_m = std::min(lowest_m, relief_.height_m(row, column));
        river_km2 = std::max<double>(river_km2, river(row, column));
        const bool close = std::abs(row - at.row) <= 1 && std::abs(column - at.column) <= 1;
        if (close && (relief_.height_m(row, column) < 3.0 || relief_.steepness(row, column) > kMaxTownSteepness))
          return {};
      }
    const double height_m = relief_.height_m(at.row, at.column);
    if (height_m > 1800.0) return {};
    const bool coast = lowest_m < 0.0;
    const double by_river = river_km2 > 0.0 ? 0.35 + 0.1 * std::log10(river_km2) : 0.0;
    return 1.0 / (1.0 + height_m / 200.0) + (coast ? 0.6 : 0.0) + by_river + (coast && river_km2 > 0.0 ? 0.5 : 0.0) +
           0.3 * random_fraction();
  }

  void add_town(double radius_m) {
    std::optional<TileNode> best;
    double best_score = 0.55;  // minimum acceptable score
    for (int site = 0; site < kSites; ++site) {
      const TileNode at = any_node();
      const auto score = suitability(at);
      if (!score || *score <= best_score) continue;
      const bool taken = std::any_of(towns_.begin(), towns_.end(), [&](const PlacedTown& town) {
        return distance_m(at, town.node) < 1.5 * (radius_m + town.radius_m);
      });
      if (taken) continue;
      best_score = *score;
      best = at;
    }
    if (!best) return;
    towns_.push_back({*best, radius_m});
    settlements_.towns.push_back({relief_.node(best->row, best->column), radius_m});
  }

  // Mean height [m MSL] of a site for an airfield; nullopt unless the site is level, dry and clear of rivers, towns and
  // other airfields.
  std::optional<double> pad_height_m(TileNode at, double bearing_deg, double length_m) {
    for (const PlacedTown& town : towns_)
      if (distance_m(at, town.node) < town.radius_m * 1.2 + 0.5 * length_m) return {};
    for (const TileNode other : airfields_)
      if (distance_m(at, other) < 25000.0) return {};
    const double turn = bearing_deg * geo::kRadiansPerDegree;
    const double half_extent_m = 0.5 * length_m + kPadBeyond_m + kPadBlend_m;
    double min_m = 1e9, max_m = -1e9, sum_m = 0.0;
    int count = 0;
    for (int row = at.row - 3; row <= at.row + 3; ++row)
      for (int column = at.column - kEdgeMargin; column <= at.column + kEdgeMargin; ++column) {
        const double north_m = (row - at.row) * kNodeMetres;
        const double east_m = (column - at.column) * kNodeMetres * parallel_;
        const double along_m = std::abs(east_m * std::sin(turn) + north_m * std::cos(turn));
        const double across_m = std::abs(east_m * std::cos(turn) - north_m * std::sin(turn));
        if (along_m > half_extent_m + kNodeMetres || across_m > kPadHalfWidth_m + kPadBlend_m + 2.0 * kNodeMetres)
          continue;
        if (river(row, column) > 0.0F || relief_.height_m(row, column) < 2.0) return {};
        if (across_m > kPadHalfWidth_m + kNodeMetres) continue;
        const double height_m = relief_.height_m(row, column);
        min_m = std::min(min_m, height_m);
        max_m = std::max(max_m, height_m);
        sum_m += height_m;
        ++count;
      }
    if (count == 0 || max_m - min_m > kPadUneven_m || min_m < 3.0) return {};
    return std::max(3.0, std::round(sum_m / count));
  }

  void add_airfield() {
    const double bearing_deg = 10.0 * static_cast<int>(18.0 * random_fraction());
    const double length_m = 2000.0 + 1000.0 * random_fraction();
    for (int site = 0; site < kAirfieldSites; ++site) {
      const TileNode at = any_node();
      const auto height_m = pad_height_m(at, bearing_deg, length_m);
      if (!height_m) continue;
      airfields_.push_back(at);
      settlements_.airfields.push_back({relief_.node(at.row, at.column), bearing_deg, length_m, *height_m});
      return;
    }
  }

  struct PlacedTown {
    TileNode node;
    double radius_m;
  };
  const ReliefTile& relief_;
  std::uint32_t seed_;
  std::vector<float> river_km2_;
  double parallel_ = 1.0;  // cosine of the tile's mean latitude, at least 0.05
  int draws_ = 0;          // random numbers drawn so far
  std::vector<PlacedTown> towns_;
  std::vector<TileNode> airfields_;
  Settlements settlements_;
};

}  // namespace

Settlements settlements_of(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed) {
  // Polar regions have no settlements.
  if (std::abs(relief.corner().south_deg + 0.5) > 68.0) return {};
  return SettlementMaker(relief, drainage, seed).make();
}

RunwayPosition runway_position(const Airfield& airfield, geo::GeoPoint position) {
  double east_deg = position.longitude_deg - airfield.centre.longitude_deg;
  if (east_deg > 180.0) east_deg -= 360.0;
  if (east_deg < -180.0) east_deg += 360.0;
  const double east_m = east_deg * east_m_per_degree(airfield.centre.latitude_deg);
  const double north_m = (position.latitude_deg - airfield.centre.latitude_deg) * kTileMetres;
  const double turn = airfield.bearing_deg * geo::kRadiansPerDegree;
  return {east_m * std::sin(turn) + north_m * std::cos(turn), east_m * std::cos(turn) - north_m * std::sin(turn)};
}

namespace {

constexpr GullyOctave kValleys[] = {{9000, 0.27}, {4300, 0.24}};
// [tiles] Limit of each cache. The relief of a tile takes 60 kB, its features less. A block of 8 x 8 cells (`yars
// terrain generate`) needs about 200 tiles, so 700 tiles are enough for three neighbouring blocks. With a limit below
// 200, tiles of one block would be computed again.
constexpr std::size_t kTilesKept = 700;

}  // namespace

LandscapeTiles::LandscapeTiles(std::uint32_t seed, std::optional<LandscapeBox> island)
    : seed_(seed),
      broad_(seed, island),
      valleys_{seed + 2048U, kValleys},
      basins_(broad_),
      reliefs_(kTilesKept),
      drainages_(kTilesKept),
      features_(kTilesKept) {}

std::shared_ptr<const ReliefTile> LandscapeTiles::relief(CellCorner corner) {
  return reliefs_.get(corner, [&] { return ReliefTile(corner, broad_, valleys_); });
}

std::shared_ptr<const Drainage> LandscapeTiles::drainage(CellCorner corner) {
  return drainages_.get(corner, [&] {
    if (basins_.frozen(corner)) return Drainage{};
    std::vector<RiverEntry> entries;
    for (const RiverGate& gate : basins_.entries(corner)) {
      if (!basins_.coastal(gate.from)) {
        entries.push_back({gate, basins_.drained_km2(gate.from)});
        continue;
      }
      // An exit of a coastal tile leads to a tile with more sea. So each recursive call is for a tile with less sea,
      // and the recursion ends.
      const auto above = drainage(gate.from);
      for (std::size_t exit = 0; exit < above->exits.size(); ++exit)
        if (above->exits[exit].to == corner && above->exits[exit].along == gate.along)
          entries.push_back({gate, above->exits_km2[exit]});
    }
    Drainage drained = drain(*relief(corner), basins_.exits(corner), std::move(entries));
    // The drained area of a river that leaves an inland tile must equal the drained area that the neighbouring tile
    // uses for its entry (`entries` above).
    if (!basins_.coastal(corner))
      std::fill(drained.exits_km2.begin(), drained.exits_km2.end(), basins_.drained_km2(corner));
    return drained;
  });
}

std::shared_ptr<const TileFeatures> LandscapeTiles::features(CellCorner corner) {
  return features_.get(corner, [&] {
    TileFeatures features{*drainage(corner), {}, {}};
    const auto land = relief(corner);
    features.rivers = river_pieces(*land, features.drainage, seed_ + 2560U);
    features.settlements = settlements_of(*land, features.drainage, seed_ + 2570U);
    return features;
  });
}

}  // namespace yars::worldgen
