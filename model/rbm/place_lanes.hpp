// Two polynomials over the samples of a sweep, in double, by vectors (Highway, chosen at run time; equal bits on every
// target).
#pragma once

#include <array>
#include <cstddef>

namespace yars::model::rbm::places {

// Newton's form: difference[0] + (t - knot[0]) (difference[1] + (t - knot[1]) ...) [deg], t in [-1, 1].
struct Curve {
  int knots = 0;
  std::array<double, 9> knot{};
  std::array<double, 9> difference{};
};

// Whole degrees and the rest of both. Arrays have terrain::kRunSlack entries more.
struct Places {
  float* cells_north;
  float* cells_east;
  float* north_deg;
  float* east_deg;
};

// t = distance * scale - 1. Both curves have the same number of knots.
void along_curves(std::size_t count, const float* distance_m, double scale, const Curve& north, const Curve& east,
                  const Places& places);

}  // namespace yars::model::rbm::places
