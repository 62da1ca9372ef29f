#include "lib/radar/velocity_beams.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace yars::radar {

using geo::Vector3;

namespace {

// [1] minimum determinant of the normal matrix of unit vectors. Below it all beams are within a few degrees of one
// plane, and the velocity across that plane is mostly noise.
constexpr double kMinDeterminant = 1e-3;

// Symmetric 3 x 3 matrix by rows.
using Matrix = std::array<Vector3, 3>;

// Inverse of the normal matrix, which is the sum of line times line transposed. nullopt: nearly singular.
std::optional<Matrix> inverse_of_normal_matrix(std::span<const Vector3> lines) {
  Matrix rows;
  for (const Vector3& line : lines) {
    rows[0] = rows[0] + line.x * line;
    rows[1] = rows[1] + line.y * line;
    rows[2] = rows[2] + line.z * line;
  }
  const Matrix cofactors{cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
  const double determinant = dot(rows[0], cofactors[0]);
  // The negated comparison also rejects NaN.
  if (!(determinant >= kMinDeterminant)) return std::nullopt;
  return Matrix{1.0 / determinant * cofactors[0], 1.0 / determinant * cofactors[1], 1.0 / determinant * cofactors[2]};
}

}  // namespace

Vector3 line_of_sight(geo::Bearing azimuth, geo::Angle elevation) {
  const double horizontal = std::cos(elevation.radians());
  return {horizontal * std::cos(azimuth.radians()), horizontal * std::sin(azimuth.radians()),
          -std::sin(elevation.radians())};
}

std::optional<Vector3> velocity_of(std::span<const Vector3> lines, std::span<const double> speeds_mps) {
  const auto inverse = inverse_of_normal_matrix(lines);
  if (!inverse) return std::nullopt;
  Vector3 sum;
  for (std::size_t i = 0; i < lines.size(); ++i) sum = sum + speeds_mps[i] * lines[i];
  return Vector3{dot((*inverse)[0], sum), dot((*inverse)[1], sum), dot((*inverse)[2], sum)};
}

std::optional<double> horizontal_dilution(std::span<const Vector3> lines) {
  const auto inverse = inverse_of_normal_matrix(lines);
  if (!inverse) return std::nullopt;
  return std::sqrt(0.5 * ((*inverse)[0].x + (*inverse)[1].y));
}

std::optional<double> horizontal_dilution(const NavigationConfiguration& navigation) {
  std::array<Vector3, kMaxVelocityBeams> lines;
  const std::size_t beams =
      std::min({lines.size(), navigation.beam_azimuths_deg.size(), navigation.beam_depressions_deg.size()});
  for (std::size_t i = 0; i < beams; ++i)
    lines[i] = line_of_sight(geo::Bearing::degrees(navigation.beam_azimuths_deg[i]),
                             geo::Angle::degrees(-navigation.beam_depressions_deg[i]));
  return horizontal_dilution(std::span<const Vector3>(lines.data(), beams));
}

}  // namespace yars::radar
