// Latitude and longitude polynomials of a ray, evaluated at the samples in Highway vectors. Results are equal bit by
// bit on every target. The ray is divided into short pieces. For each piece the polynomials are expanded in double
// about the piece's middle. At the piece's samples they are evaluated as cubics in float. A ray of fewer than 192
// samples has no pieces: the polynomials are evaluated in double at its samples.
// Accuracy: 8 mm against evaluation in double for a ray of 160 NM. Rounding the fraction of a degree to float
// contributes up to 4 mm.
#pragma once

#include <array>
#include <cstddef>

namespace yars::model::physics::simd {

inline constexpr std::size_t kMaxTerms = 9;

// Polynomial [deg]: sum of coefficient[k] x^k for k < terms. x = distance * scale - shift (Curves).
struct Curve {
  std::size_t terms = 0;
  std::array<double, kMaxTerms> coefficient{};
};
struct Curves {
  double scale = 1.0;  // [1/m]
  double shift = 0.0;
  Curve north, east;  // with equal numbers of terms
};

// Output: value of each polynomial as whole degrees and a fraction. Arrays have terrain::kRunSlack more
// entries than samples.
struct PositionSpans {
  float* cells_north;
  float* cells_east;
  float* north_deg;
  float* east_deg;
};

// Computes `count` positions. `distance_m` is ascending; terrain::kRunSlack more entries are read.
void positions_on_curves(std::size_t count, const float* distance_m, const Curves& curves,
                         const PositionSpans& positions);

}  // namespace yars::model::physics::simd
