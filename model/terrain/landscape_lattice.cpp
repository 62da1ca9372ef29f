#include "model/terrain/landscape_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::terrain {

namespace {

// Weights of a uniform cubic B-spline over four lattice points, and their derivatives.
struct Spline {
  std::array<double, 4> value;
  std::array<double, 4> change;
};
Spline spline_at(double t) {
  const double s = 1.0 - t;
  return {
      {s * s * s / 6.0, (3 * t * t * t - 6 * t * t + 4) / 6.0, (3 * s * s * s - 6 * s * s + 4) / 6.0, t * t * t / 6.0},
      {-s * s / 2.0, (3 * t * t - 4 * t) / 2.0, (4 * s - 3 * s * s) / 2.0, t * t / 2.0}};
}

}  // namespace

LandscapeLattice::LandscapeLattice(CellPlace place, int columns,
                                   const std::function<const ReliefTile&(CellPlace)>& tile_at)
    : place_(place), heights_m_(static_cast<std::size_t>(kNodes) * kNodes) {
  for (int north = -1; north <= 1; ++north)
    for (int east = -1; east <= 1; ++east) {
      const ReliefTile& tile = tile_at(neighbour_of(place, north, east));
      // Nodes of this tile among ours.
      for (int row = std::max(0, kMargin + north * kTileNodes);
           row < std::min(kNodes, kMargin + (north + 1) * kTileNodes); ++row)
        for (int column = std::max(0, kMargin + east * kTileNodes);
             column < std::min(kNodes, kMargin + (east + 1) * kTileNodes); ++column)
          heights_m_[static_cast<std::size_t>(row) * kNodes + static_cast<std::size_t>(column)] =
              tile.height_m(row - kMargin - north * kTileNodes, column - kMargin - east * kTileNodes);
    }
  columns_.reserve(static_cast<std::size_t>(columns));
  constexpr int kRound = kCellColumns * kTileNodes;
  for (int column = 0; column < columns; ++column) {
    const int steps = column * kTileNodes;
    const double fraction = static_cast<double>(steps % (columns - 1)) / (columns - 1);
    const int node = steps / (columns - 1);
    const int of_earth = ((place.west_deg + 180) * kTileNodes + node) % kRound;
    const Spline spline = spline_at(fraction);
    columns_.push_back({node + kMargin - 1, (of_earth + fraction) / kTileNodes - 180.0, spline.value, spline.change});
  }
}

LandscapeLattice::Row::Row(const LandscapeLattice& lattice, int post, int intervals)
    : lattice_(&lattice), value_m_(kNodes), change_m_(kNodes) {
  const int steps = post * kTileNodes;
  const double fraction = static_cast<double>(steps % intervals) / intervals;
  const int node = steps / intervals;
  latitude_deg_ = ((lattice.place_.south_deg + 90) * kTileNodes + node + fraction) / kTileNodes - 90.0;
  east_per_node_m_ = east_m_per_degree(latitude_deg_) / kTileNodes;
  const Spline spline = spline_at(fraction);
  for (std::size_t tap = 0; tap < 4; ++tap) {
    // On the cell's north edge the fourth tap has no weight and may stay inside.
    const int row = std::min(node + kMargin - 1 + static_cast<int>(tap), kNodes - 1);
    const double* nodes = &lattice.heights_m_[static_cast<std::size_t>(row) * kNodes];
    for (std::size_t column = 0; column < kNodes; ++column) {
      value_m_[column] += spline.value[tap] * nodes[column];
      change_m_[column] += spline.change[tap] * nodes[column];
    }
  }
}

LandscapeLattice::Ground LandscapeLattice::Row::at(int column) const {
  const Column& taps = lattice_->columns_[static_cast<std::size_t>(column)];
  Ground ground;
  double east = 0.0;
  double north = 0.0;
  for (std::size_t tap = 0; tap < 4; ++tap) {
    const auto node = static_cast<std::size_t>(std::min(taps.first + static_cast<int>(tap), kNodes - 1));
    ground.height_m += taps.value[tap] * value_m_[node];
    east += taps.change[tap] * value_m_[node];
    north += taps.value[tap] * change_m_[node];
  }
  ground.slope = {east / east_per_node_m_, north / kNodeMetres};
  return ground;
}

}  // namespace yars::model::terrain
