#include "model/terrain/landscape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "model/terrain/noise.hpp"

namespace yars::model::terrain {

namespace {

constexpr int kLatticePerDegree = 120;         // broad shapes are sampled every 30 arc seconds
constexpr double kEarthRadiusKm = 6371.0;      // [km] sphere: shape only, no navigation
constexpr double kMetresPerDegree = 111195.0;  // [m] of that sphere

double smooth_step(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double bell(double offset, double half_width) {
  const double t = offset / half_width;
  return std::exp(-t * t);
}

geo::Vector3 at_wavelength(geo::Vector3 point_km, double wavelength_km) {
  return {point_km.x / wavelength_km, point_km.y / wavelength_km, point_km.z / wavelength_km};
}

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

// A post's place on the lattice: exact in integers, so that neighbours compute the same bits.
struct LatticePosition {
  int node = 0;
  double fraction = 0.0;
};
LatticePosition lattice_position(int degree, int post, int posts_per_degree) {
  const int steps = post * kLatticePerDegree;
  return {degree * kLatticePerDegree + steps / posts_per_degree,
          static_cast<double>(steps % posts_per_degree) / posts_per_degree};
}

}  // namespace

Landscape::Landscape(std::uint64_t seed)
    : seed_(static_cast<std::uint32_t>(seed ^ (seed >> 32U)) * 4096U), gullies_(seed_ + 2048U) {}

double Landscape::broad_height_m(geo::GeoPoint place) const {
  const double latitude = place.latitude_deg * geo::kRadiansPerDegree;
  const double longitude = place.longitude_deg * geo::kRadiansPerDegree;
  geo::Vector3 at{kEarthRadiusKm * std::cos(latitude) * std::cos(longitude),
                  kEarthRadiusKm * std::cos(latitude) * std::sin(longitude), kEarthRadiusKm * std::sin(latitude)};
  // Bend space a little: what is straight in noise becomes winding.
  const geo::Vector3 bent{at.x + 9.0 * fractal_noise(at_wavelength(at, 55), seed_ + 10, 3, 0.5),
                          at.y + 9.0 * fractal_noise(at_wavelength(at, 55), seed_ + 20, 3, 0.5),
                          at.z + 9.0 * fractal_noise(at_wavelength(at, 55), seed_ + 30, 3, 0.5)};
  // Way inland from the coast's general line, negative at sea.
  const double inland_km = 260.0 * (gradient_noise(at_wavelength(bent, 1100), seed_ + 40) +
                                    0.45 * gradient_noise(at_wavelength(bent, 430), seed_ + 41) +
                                    0.16 * gradient_noise(at_wavelength(bent, 170), seed_ + 42));
  const double rugged_coast = smooth_step(-0.3, 0.4, gradient_noise(at_wavelength(at, 130), seed_ + 43));
  const double coast_km =
      inland_km + (9.0 + 26.0 * rugged_coast) * fractal_noise(at_wavelength(bent, 62), seed_ + 50, 6, 0.5);
  // Shelf and coastal plain.
  double height_m =
      coast_km < 0 ? 14.0 * coast_km : 95.0 * (1.0 - std::exp(-coast_km / 14.0)) + 1.6 * std::min(coast_km, 90.0);
  // Ranges follow the general line at their own distance and with their own gaps.
  const double wander_km = 26.0 * fractal_noise(at_wavelength(at, 120), seed_ + 60, 3, 0.5);
  const auto range = [&](double axis_km, double half_width_km, double crest_m, std::uint32_t layer) {
    const double presence =
        0.45 + 0.75 * smooth_step(-0.45, 0.35, fractal_noise(at_wavelength(at, 95), seed_ + layer, 2, 0.5));
    const double envelope = bell(inland_km - axis_km - wander_km, half_width_km) * presence;
    const double ridges = ridged_noise(at_wavelength(bent, 34), seed_ + layer + 5, 4);
    return crest_m * envelope * (0.28 + 1.05 * ridges);
  };
  height_m += range(20, 12, 1250, 70) + range(96, 27, 3000, 90) + range(210, 40, 2300, 110);
  // Islands: drowned hills of an outer chain.
  height_m += range(-30, 9, 900, 130) * 0.75;
  // Low hills wherever there is no range.
  const double hills = ridged_noise(at_wavelength(bent, 17), seed_ + 150, 4);
  height_m += 190.0 * hills * smooth_step(2.0, 25.0, coast_km) *
              smooth_step(-0.1, 0.5, fractal_noise(at_wavelength(at, 60), seed_ + 160, 2, 0.5));
  return height_m;
}

Cell Landscape::cell(CellPlace place, int rows, int columns) const {
  constexpr int kNodes = kLatticePerDegree + 4;  // a cell's nodes, one before and two beyond
  const int first_row = (place.south_deg + 90) * kLatticePerDegree - 1;
  const int first_column = (place.west_deg + 180) * kLatticePerDegree - 1;
  std::vector<double> lattice(static_cast<std::size_t>(kNodes) * kNodes);
  constexpr int kRound = kCellColumns * kLatticePerDegree;
  for (int row = 0; row < kNodes; ++row)
    for (int column = 0; column < kNodes; ++column) {
      const int wrapped = (first_column + column + kRound) % kRound;
      lattice[static_cast<std::size_t>(row * kNodes + column)] =
          broad_height_m({static_cast<double>(first_row + row) / kLatticePerDegree - 90.0,
                          static_cast<double>(wrapped) / kLatticePerDegree - 180.0});
    }
  std::vector<std::int16_t> posts(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  std::vector<double> line(kNodes);
  std::vector<double> line_change(kNodes);
  for (int row = 0; row < rows; ++row) {
    const LatticePosition north = lattice_position(place.south_deg + 90, row, rows - 1);
    const Spline up = spline_at(north.fraction);
    const double latitude_deg = (north.node + north.fraction) / kLatticePerDegree - 90.0;
    for (int column = 0; column < kNodes; ++column) {
      line[column] = 0;
      line_change[column] = 0;
      for (int tap = 0; tap < 4; ++tap) {
        // The last post of a cell stands on a node: its fourth tap has no weight and may stay inside.
        const int node = std::min(north.node - 1 + tap - first_row, kNodes - 1);
        line[column] += up.value[tap] * lattice[static_cast<std::size_t>(node * kNodes + column)];
        line_change[column] += up.change[tap] * lattice[static_cast<std::size_t>(node * kNodes + column)];
      }
    }
    const double north_per_node_m = kMetresPerDegree / kLatticePerDegree;
    const double east_per_node_m = north_per_node_m * std::max(0.01, std::cos(latitude_deg * geo::kRadiansPerDegree));
    for (int column = 0; column < columns; ++column) {
      const LatticePosition east = lattice_position(place.west_deg + 180, column, columns - 1);
      const Spline right = spline_at(east.fraction);
      double broad_m = 0;
      Slope slope;
      for (int tap = 0; tap < 4; ++tap) {
        const int node = std::min(east.node - 1 + tap - first_column, kNodes - 1);
        broad_m += right.value[tap] * line[node];
        slope.east += right.change[tap] * line[node] / east_per_node_m;
        slope.north += right.value[tap] * line_change[node] / north_per_node_m;
      }
      double height_m = broad_m;
      if (broad_m > -150.0) {
        const int round = kCellColumns * kLatticePerDegree;
        const double longitude_deg = (east.node % round + east.fraction) / kLatticePerDegree - 180.0;
        height_m += gullies_.relief_m(latitude_deg, longitude_deg, slope);
      }
      const double rounded = std::round(height_m);
      posts[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] =
          height_m <= 0.0 ? std::int16_t{0} : static_cast<std::int16_t>(std::clamp(rounded, 1.0, 9000.0));
    }
  }
  return Cell(place, rows, columns, std::move(posts));
}

}  // namespace yars::model::terrain
