// Velocity over ground from the Doppler speeds of several beams, by least squares.
// Inputs: unit vectors of the lines of sight, and the speed [m/s] along each.
// Outputs: the velocity [m/s], and its standard deviation for a given standard deviation of the beams.
// Frame: north, east, down; or forward, right, down of the ground track. Azimuths count from the first axis.
// Errors: std::nullopt for fewer than three beams and for beams that are nearly in one plane.
// Source: normal equations of linear least squares.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::radar {

struct NavigationConfiguration;

inline constexpr std::size_t kMinVelocityBeams = 3;  // three unknowns
inline constexpr std::size_t kMaxVelocityBeams = 8;  // size of fixed arrays

// Unit vector of an azimuth and an elevation (up positive).
geo::Vector3 line_of_sight(geo::Bearing azimuth, geo::Angle elevation);

// Velocity [m/s] with the least squared error of the speeds along `lines`. `speeds_mps` has one speed for each line.
std::optional<geo::Vector3> velocity_of(std::span<const geo::Vector3> lines, std::span<const double> speeds_mps);

// Horizontal dilution of precision: root mean square of the standard deviations of the two horizontal components, for a
// standard deviation of 1 of each beam.
std::optional<double> horizontal_dilution(std::span<const geo::Vector3> lines);

// The same for the beams of a configuration. Azimuths and depressions without a partner are not used.
std::optional<double> horizontal_dilution(const NavigationConfiguration& navigation);

}  // namespace yars::radar
