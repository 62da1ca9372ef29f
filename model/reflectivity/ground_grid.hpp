// The earth cut into cells of about one size, each with random bits of its own: what stays on the ground from scan to
// scan is keyed by them. Rows of equal latitude; the columns of a row follow the cosine at the middle of its degree.
#pragma once

#include <array>
#include <cstdint>

#include "lib/geo/geodesic.hpp"

namespace yars::model::reflectivity {

struct GroundGrid {
  double rows_per_degree = 0.0;
  std::array<double, 180> columns{};  // cells round the earth, by whole degrees of latitude from the south pole
};

// A cell's number is its row times this plus its column: the golden section of 2^32, so that no two cells within
// thousands of rows share one.
inline constexpr std::uint32_t kRowFactor = 0x9e3779b1U;

// Cells of this edge [m] (> 0), within 2 % of it below 60 degrees of latitude.
GroundGrid make_ground_grid(double edge_m);

// 32 random bits of the cell that holds a place. Any longitude; latitude within +-90 degrees.
std::uint32_t ground_bits(const GroundGrid& grid, geo::GeoPoint place);

}  // namespace yars::model::reflectivity
