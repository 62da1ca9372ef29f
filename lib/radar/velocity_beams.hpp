// How several beams measure the aircraft's velocity over ground. Each measures by Doppler the speed along its own line
// of sight; least squares make one velocity of them. Vectors are north, east, down, or forward, right, down of a track:
// the same mathematics. Source: normal equations, as for any navigation by ranges or range rates.
#pragma once

#include <optional>
#include <span>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::radar {

inline constexpr std::size_t kMinVelocityBeams = 3;
inline constexpr std::size_t kMaxVelocityBeams = 8;

// The unit vector into a direction.
geo::Vector3 line_of_sight(geo::Bearing azimuth, geo::Angle elevation);

// The velocity [m/s] that fits these speeds [m/s] toward their lines of sight best. As many speeds as lines; nothing
// where the lines are fewer than three, or so near to one plane that the velocity across it is lost.
std::optional<geo::Vector3> velocity_of(std::span<const geo::Vector3> lines, std::span<const double> speeds_mps);

// Standard deviation of a horizontal component of that velocity (the root mean square of the two) for a standard
// deviation of 1 of every beam. Nothing as above.
std::optional<double> horizontal_dilution(std::span<const geo::Vector3> lines);

// Of the beams of a configuration: as many as azimuths and depressions go in pairs.
std::optional<double> horizontal_dilution(const NavigationConfiguration& navigation);

}  // namespace yars::radar
