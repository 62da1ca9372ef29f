#include "model/terrain/landscape_relief.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::terrain {

geo::GeoPoint lattice_node(int row, int column) {
  constexpr int kRound = kCellColumns * kTileNodes;
  const int wrapped = (column % kRound + kRound) % kRound;
  return {static_cast<double>(row) / kTileNodes - 90.0, static_cast<double>(wrapped) / kTileNodes - 180.0};
}

double east_m_per_degree(double latitude_deg) {
  return kTileMetres * std::max(0.01, std::cos(latitude_deg * geo::kRadiansPerDegree));
}

CellPlace neighbour_of(CellPlace place, int north, int east) {
  return {place.south_deg + north, (place.west_deg + east + 180 + kCellColumns) % kCellColumns - 180};
}

ReliefTile::ReliefTile(CellPlace place, const BroadRelief& broad, const Gullies& valleys)
    : place_(place), heights_m_(static_cast<std::size_t>(kSide) * kSide) {
  for (int row = -1; row <= kTileNodes; ++row)
    for (int column = -1; column <= kTileNodes; ++column)
      heights_m_[slot(row, column)] = static_cast<float>(broad.height_m(node(row, column)));
  const std::vector<float> before = heights_m_;
  constexpr double kHalfSteps = kTileNodes / 2.0;
  for (int row = 0; row < kTileNodes; ++row) {
    const double latitude_deg = node(row, 0).latitude_deg;
    GullyRow cuts(valleys, std::clamp(latitude_deg, -90.0, 90.0));
    for (int column = 0; column < kTileNodes; ++column) {
      const std::size_t here = slot(row, column);
      const Slope slope{(before[here + 1] - before[here - 1]) * kHalfSteps / east_m_per_degree(latitude_deg),
                        (before[here + kSide] - before[here - kSide]) * kHalfSteps / kTileMetres};
      heights_m_[here] += static_cast<float>(cuts.at(node(row, column).longitude_deg, slope).height_m);
    }
  }
}

geo::GeoPoint ReliefTile::node(int row, int column) const {
  return lattice_node((place_.south_deg + 90) * kTileNodes + row, (place_.west_deg + 180) * kTileNodes + column);
}

double ReliefTile::steepness(int row, int column) const {
  const double east = (height_m(row, column + 1) - height_m(row, column - 1)) * (kTileNodes / 2.0) /
                      east_m_per_degree(node(row, column).latitude_deg);
  const double north = (height_m(row + 1, column) - height_m(row - 1, column)) / (2.0 * kNodeMetres);
  return std::sqrt(east * east + north * north);
}

}  // namespace yars::model::terrain
