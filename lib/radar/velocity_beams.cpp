#include "lib/radar/velocity_beams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "lib/radar/mission.hpp"

namespace yars::radar {

using geo::Vector3;

namespace {

// [1] minimum determinant of the normal matrix of unit vectors. Below it all beams are within a few degrees of one
// plane, and the velocity across that plane is mostly noise.
constexpr double kMinDeterminant = 1e-3;

// Inverse of the normal matrix, the sum of each line times its transpose.
std::optional<glm::dmat3> inverse_of_normal_matrix(std::span<const Vector3> lines) {
  glm::dmat3 normal(0.0);
  for (const Vector3& line : lines) normal += glm::outerProduct(line, line);
  // Written so that NaN fails.
  if (!(glm::determinant(normal) >= kMinDeterminant)) return std::nullopt;
  return glm::inverse(normal);
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
  for (std::size_t i = 0; i < lines.size(); ++i) sum += speeds_mps[i] * lines[i];
  return *inverse * sum;
}

std::optional<double> horizontal_dilution(std::span<const Vector3> lines) {
  const auto inverse = inverse_of_normal_matrix(lines);
  if (!inverse) return std::nullopt;
  return std::sqrt(0.5 * ((*inverse)[0][0] + (*inverse)[1][1]));
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
