// Directions in airframe axes, and the limits of the antenna's gimbal.
// Inputs: attitude of the aircraft; true azimuth and elevation above the horizontal; limits of the configuration.
// Source: docs/pilots_manual.md#rule-2.
#pragma once

#include "lib/geo/quantity.hpp"

namespace yars::radar {

struct AntennaConfiguration;

// Attitude and ground track of the aircraft. Heading and track are true. Pitch is positive with the nose up, roll with
// the right wing down.
struct Platform {
  geo::Bearing heading;
  geo::Angle pitch;
  geo::Angle roll;
  geo::Bearing ground_track;  // equals the heading at ground speeds below 1 m/s
};

struct GimbalAngles {
  geo::Angle azimuth;    // positive right of the nose
  geo::Angle elevation;  // positive above the wing plane
};
// Rotates a direction (true azimuth, elevation above the horizontal) into airframe axes.
GimbalAngles gimbal_from_space(const Platform& platform, geo::Bearing azimuth, geo::Angle elevation);

// True if the direction is within the gimbal limits plus the servo's tolerance. A circular scan has no azimuth limit.
bool within_gimbal(const Platform& platform, const AntennaConfiguration& antenna, geo::Bearing azimuth,
                   geo::Angle elevation);

}  // namespace yars::radar
