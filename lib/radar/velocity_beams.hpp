// Velocity over ground from the Doppler speeds of several beams, by least squares.
// Inputs: unit vectors of the lines of sight, and the aircraft's speed [m/s] along each, positive towards the ground.
// Outputs: the velocity [m/s], and its horizontal dilution of precision.
// Frame: north, east, down; or forward, right, down relative to the ground track. The first axis has azimuth 0.
// Errors: std::nullopt for fewer than three beams, beams nearly in one plane, and a direction that is NaN.
// Source: normal equations of linear least squares.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <span>

#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::radar {

inline constexpr std::size_t kMinVelocityBeams = 3;  // one for each velocity component
inline constexpr std::size_t kMaxVelocityBeams = 8;  // size of arrays with one element per beam

// Minimum determinant of the normal matrix of unit vectors, dimensionless. Below this value all beams are within a few
// degrees of one plane, and the measured velocity across that plane is mostly noise.
inline constexpr double kMinDeterminant = 1e-3;

// Inverse of the normal matrix, which is the sum of the outer products of each unit vector with itself.
inline std::optional<glm::dmat3> inverse_of_normal_matrix(std::span<const geo::Vector3> lines) {
  glm::dmat3 normal(0.0);
  for (const geo::Vector3& line : lines) normal += glm::outerProduct(line, line);
  // The negated comparison also rejects NaN.
  if (!(glm::determinant(normal) >= kMinDeterminant)) return std::nullopt;
  return glm::inverse(normal);
}

// Unit vector of an azimuth and an elevation. A positive elevation points up, so that the down component is negative.
inline geo::Vector3 line_of_sight(geo::Bearing azimuth, geo::Angle elevation) {
  const double horizontal = std::cos(elevation.radians());
  return {horizontal * std::cos(azimuth.radians()), horizontal * std::sin(azimuth.radians()),
          -std::sin(elevation.radians())};
}

// Velocity [m/s] with the least sum of squared errors of the speeds along `lines`. `speeds_mps` has one speed per line.
inline std::optional<geo::Vector3> velocity_of(std::span<const geo::Vector3> lines,
                                               std::span<const double> speeds_mps) {
  YARS_REQUIRE(lines.size(), ==, speeds_mps.size());
  const auto inverse = inverse_of_normal_matrix(lines);
  if (!inverse) return std::nullopt;
  geo::Vector3 sum;
  for (std::size_t i = 0; i < lines.size(); ++i) sum += speeds_mps[i] * lines[i];
  return *inverse * sum;
}

// Horizontal dilution of precision: root mean square of the standard deviations [m/s] of the two horizontal components,
// if the speed along each beam has a standard deviation of 1 m/s.
inline std::optional<double> horizontal_dilution(std::span<const geo::Vector3> lines) {
  const auto inverse = inverse_of_normal_matrix(lines);
  if (!inverse) return std::nullopt;
  return std::sqrt(0.5 * ((*inverse)[0][0] + (*inverse)[1][1]));
}

// Horizontal dilution of precision of the configured beams. An azimuth without a depression, a depression without an
// azimuth, and beams after the first kMaxVelocityBeams are ignored.
inline std::optional<double> horizontal_dilution(std::span<const double> azimuths_deg,
                                                 std::span<const double> depressions_deg) {
  std::array<geo::Vector3, kMaxVelocityBeams> lines;
  const std::size_t beams = std::min({lines.size(), azimuths_deg.size(), depressions_deg.size()});
  for (std::size_t i = 0; i < beams; ++i)
    lines[i] = line_of_sight(geo::Bearing::degrees(azimuths_deg[i]), geo::Angle::degrees(-depressions_deg[i]));
  return horizontal_dilution(std::span<const geo::Vector3>(lines.data(), beams));
}

}  // namespace yars::radar
