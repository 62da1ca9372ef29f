// Velocity over ground from the Doppler speeds of several beams, by least squares.
// Inputs: unit vectors of the lines of sight, and the speed [m/s] along each of them.
// Outputs: the velocity [m/s], and its horizontal dilution of precision.
// Frame: north, east, down; or forward, right, down relative to the ground track. The first axis has azimuth 0.
// Errors: std::nullopt for fewer than three beams and for beams that are nearly in one plane.
// Source: normal equations of linear least squares.
#pragma once

#include <optional>
#include <span>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::radar {

inline constexpr std::size_t kMinVelocityBeams = 3;  // three unknowns
inline constexpr std::size_t kMaxVelocityBeams = 8;  // size of fixed arrays

// Unit vector of an azimuth and an elevation. A positive elevation points up, so that the down component is negative.
geo::Vector3 line_of_sight(geo::Bearing azimuth, geo::Angle elevation);

// Velocity [m/s] with the least squared error of the speeds along `lines`. `speeds_mps` has one speed for each line.
std::optional<geo::Vector3> velocity_of(std::span<const geo::Vector3> lines, std::span<const double> speeds_mps);

// Horizontal dilution of precision: root mean square of the standard deviations of the two horizontal components, if
// the speed along each beam has a standard deviation of 1 m/s.
std::optional<double> horizontal_dilution(std::span<const geo::Vector3> lines);

// Horizontal dilution of precision of the configured beams. Only azimuths that also have a depression are used.
std::optional<double> horizontal_dilution(const NavigationConfiguration& navigation);

}  // namespace yars::radar
