// Two polynomials over the samples of a sweep by vectors (Highway, chosen at run time; equal bits on every target): in
// double about the middles of short pieces, each a cubic in float. Within 8 mm of double throughout for a ray of 160
// NM; 4 mm of it are what float leaves of a degree.
#pragma once

#include <array>
#include <cstddef>

namespace yars::model::physics::simd {

inline constexpr std::size_t kMaxTerms = 9;

// coefficient[0] + x (coefficient[1] + x (...)) [deg], x = distance * scale - shift.
struct Curve {
  std::size_t terms = 0;
  std::array<double, kMaxTerms> coefficient{};
};
struct Curves {
  double scale = 1.0;  // [1/m]
  double shift = 0.0;
  Curve north, east;  // as many terms
};

// Whole degrees and the rest of both. Arrays have terrain::kRunSlack entries more.
struct Places {
  float* cells_north;
  float* cells_east;
  float* north_deg;
  float* east_deg;
};

// Samples of a piece for so many of a sweep; 0: too few for pieces.
std::size_t piece_samples(std::size_t count);

// Distances [m] ascending, terrain::kRunSlack more are read. `piece` as piece_samples() gives it, not 0.
void along_curves(std::size_t count, std::size_t piece, const float* distance_m, const Curves& curves,
                  const Places& places);

}  // namespace yars::model::physics::simd
