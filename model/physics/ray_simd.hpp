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

// Polynomials of a ray near a pole in Newton's form: components of the unit vector in t = distance * scale - 1.
// component = d[0] + (t - knot[0]) (d[1] + (t - knot[1]) (d[2] + ...)), d: its row of difference.
struct VectorCurves {
  std::size_t knots = 0;
  double scale = 1.0;  // [1/m]
  std::array<double, kMaxTerms> knot{};
  std::array<std::array<double, kMaxTerms>, 3> difference{};  // x, y, z
  double apex_east_deg = 0.0;                                 // longitude of the apex; at the pole, that of the ray
  double south_deg = 0.0, west_deg = 0.0;                     // corner of the apex's cell
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

// Computes `count` positions from the direction of a unit vector. The same arrays as for positions_on_curves().
// Accuracy: 1e-12 rad, then float as above.
void positions_by_vector(std::size_t count, const float* distance_m, const VectorCurves& curves,
                         const PositionSpans& positions);

}  // namespace yars::model::physics::simd
