#include "lib/radar/sensor.hpp"

#include <algorithm>
#include <cmath>

namespace yars::radar {

GimbalAngles gimbal_from_space(const Platform& platform, geo::Bearing azimuth, geo::Angle elevation) {
  const double relative_rad = (azimuth - platform.heading).radians();
  const double sin_elevation = std::sin(elevation.radians());
  const double cos_elevation = std::cos(elevation.radians());
  // Heading axes: forward, right, down.
  const double forward = cos_elevation * std::cos(relative_rad);
  const double right = cos_elevation * std::sin(relative_rad);
  const double down = -sin_elevation;
  const double sin_pitch = std::sin(platform.pitch.radians());
  const double cos_pitch = std::cos(platform.pitch.radians());
  const double sin_roll = std::sin(platform.roll.radians());
  const double cos_roll = std::cos(platform.roll.radians());
  // Rotation by pitch about the right axis, then by roll about the nose axis.
  const double nose = cos_pitch * forward - sin_pitch * down;
  const double pitched_down = sin_pitch * forward + cos_pitch * down;
  const double wing = cos_roll * right + sin_roll * pitched_down;
  const double belly = -sin_roll * right + cos_roll * pitched_down;
  return {geo::Angle::radians(std::atan2(wing, nose)), geo::Angle::radians(std::asin(std::clamp(-belly, -1.0, 1.0)))};
}

bool within_gimbal(const Platform& platform, const AntennaConfiguration& antenna, geo::Bearing azimuth,
                   geo::Angle elevation) {
  const GimbalAngles gimbal = gimbal_from_space(platform, azimuth, elevation);
  const bool azimuth_reached =
      antenna.circular_scan || std::abs(gimbal.azimuth.degrees()) <= antenna.azimuth_limit_deg + antenna.tolerance_deg;
  return azimuth_reached && std::abs(gimbal.elevation.degrees()) <= antenna.elevation_limit_deg + antenna.tolerance_deg;
}

}  // namespace yars::radar
