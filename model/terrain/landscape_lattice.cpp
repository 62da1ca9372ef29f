#include "model/terrain/landscape_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace yars::model::terrain {

namespace {

constexpr double kMetresPerDegree = 111195.0;  // [m] of a sphere of 6371 km: shape only, no navigation

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

// Metres eastward in a degree of longitude; kept from zero at the poles, where no slope makes sense.
double east_m_per_degree(double latitude_deg) {
  return kMetresPerDegree * std::max(0.01, std::cos(latitude_deg * geo::kRadiansPerDegree));
}

}  // namespace

geo::GeoPoint LandscapeLattice::node(int row, int column) const {
  constexpr int kRound = kCellColumns * kPerDegree;
  const int wrapped = (first_column_ + column + kRound) % kRound;
  return {static_cast<double>(first_row_ + row) / kPerDegree - 90.0, static_cast<double>(wrapped) / kPerDegree - 180.0};
}

LandscapeLattice::LandscapeLattice(CellPlace place, const std::function<double(geo::GeoPoint)>& height_m)
    : first_row_((place.south_deg + 90) * kPerDegree - kMargin),
      first_column_((place.west_deg + 180) * kPerDegree - kMargin),
      heights_m_(static_cast<std::size_t>(kNodes) * kNodes),
      row_m_(kNodes),
      row_change_m_(kNodes) {
  for (int row = 0; row < kNodes; ++row)
    for (int column = 0; column < kNodes; ++column) heights_m_[slot(row, column)] = height_m(node(row, column));
}

void LandscapeLattice::cut(const Gullies& gullies) {
  const std::vector<double> before = heights_m_;
  const auto height = [&](int row, int column) { return before[slot(row, column)]; };
  // The outermost nodes lack a neighbour; no post's spline reaches them.
  for (int row = 1; row < kNodes - 1; ++row)
    for (int column = 1; column < kNodes - 1; ++column) {
      const geo::GeoPoint at = node(row, column);
      const double half_steps = kPerDegree / 2.0;
      const Slope slope{
          (height(row, column + 1) - height(row, column - 1)) * half_steps / east_m_per_degree(at.latitude_deg),
          (height(row + 1, column) - height(row - 1, column)) * half_steps / kMetresPerDegree};
      heights_m_[slot(row, column)] += gullies.relief_m(at.latitude_deg, at.longitude_deg, slope);
    }
}

void LandscapeLattice::choose_row(int post, int intervals) {
  const int steps = post * kPerDegree;
  const double fraction = static_cast<double>(steps % intervals) / intervals;
  const int first = steps / intervals + kMargin - 1;
  latitude_deg_ = (first_row_ + first + 1 + fraction) / kPerDegree - 90.0;
  east_per_node_m_ = east_m_per_degree(latitude_deg_) / kPerDegree;
  const Spline spline = spline_at(fraction);
  std::fill(row_m_.begin(), row_m_.end(), 0.0);
  std::fill(row_change_m_.begin(), row_change_m_.end(), 0.0);
  for (int tap = 0; tap < 4; ++tap) {
    // On the cell's north edge the fourth tap has no weight and may stay inside.
    const int row = std::min(first + tap, kNodes - 1);
    for (int column = 0; column < kNodes; ++column) {
      row_m_[column] += spline.value[tap] * heights_m_[slot(row, column)];
      row_change_m_[column] += spline.change[tap] * heights_m_[slot(row, column)];
    }
  }
}

LandscapeLattice::Ground LandscapeLattice::at_column(int post, int intervals) const {
  constexpr int kRound = kCellColumns * kPerDegree;
  const int steps = post * kPerDegree;
  const double fraction = static_cast<double>(steps % intervals) / intervals;
  const int first = steps / intervals + kMargin - 1;
  const Spline spline = spline_at(fraction);
  Ground ground;
  ground.latitude_deg = latitude_deg_;
  ground.longitude_deg = ((first_column_ + first + 1) % kRound + fraction) / kPerDegree - 180.0;
  for (int tap = 0; tap < 4; ++tap) {
    const int column = std::min(first + tap, kNodes - 1);
    ground.height_m += spline.value[tap] * row_m_[column];
    ground.slope.east += spline.change[tap] * row_m_[column] / east_per_node_m_;
    ground.slope.north += spline.value[tap] * row_change_m_[column] * kPerDegree / kMetresPerDegree;
  }
  return ground;
}

}  // namespace yars::model::terrain
