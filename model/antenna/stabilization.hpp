// How a scan is held in space: which way its centre points, and whether the gimbal can point the dish there.
#pragma once

#include "lib/geo/bearing.hpp"
#include "lib/geo/quantity.hpp"

#include "lib/radar/configuration.hpp"

namespace yars::model::antenna {

// What the servo knows of the aircraft. Heading and track true; pitch nose up, roll right wing down positive.
struct Platform {
  geo::Bearing heading;
  geo::Angle pitch;
  geo::Angle roll;
  geo::Bearing ground_track;  // the heading where the aircraft hardly moves
};

// The scan centre: the ground track, but not further from the nose than the drift limit.
geo::Bearing scan_centre(const Platform& platform, const radar::AntennaConfiguration& antenna);

// A direction in space as the gimbal sees it: azimuth and elevation in the axes of the airframe.
struct GimbalAngles {
  geo::Angle azimuth;    // right of the nose positive
  geo::Angle elevation;  // above the wing plane positive
};
GimbalAngles gimbal_from_space(const Platform& platform, geo::Bearing azimuth, geo::Angle elevation);

// True if the gimbal reaches the direction, within the servo's tolerance. A circular scan has no azimuth limit.
bool within_gimbal(const Platform& platform, const radar::AntennaConfiguration& antenna, geo::Bearing azimuth,
                   geo::Angle elevation);

}  // namespace yars::model::antenna
