#include "model/kernel/pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "databuffer/records/navigation.hpp"
#include "lib/radar/modes.hpp"

namespace yars::model::kernel {

namespace {
constexpr double kLeastAltitudeM = -1000.0;  // [m] MSL, of the record
constexpr double kGreatestAltitudeM = 200000.0;
// [NM] 18 m, a tenth of the shortest pulse: below it a sample's inverse cube leaves the numbers of float
constexpr double kLeastRangeNm = 0.01;
constexpr double kGreatestRangeNm = 1000.0;  // [NM] beyond it the series of the earth's curvature lose accuracy
}  // namespace

std::optional<Pose> pose_of(const databuffer::Ownship& ownship) {
  const std::array<double, 9> values{ownship.latitude_deg,       ownship.longitude_deg,     ownship.altitude_msl_m,
                                     ownship.heading_deg,        ownship.pitch_deg,         ownship.roll_deg,
                                     ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps};
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return {};
  if (std::abs(ownship.latitude_deg) > 90.0 || std::abs(ownship.longitude_deg) > 180.0) return {};
  if (ownship.altitude_msl_m < kLeastAltitudeM || ownship.altitude_msl_m > kGreatestAltitudeM) return {};
  Pose pose;
  pose.place = {ownship.latitude_deg, ownship.longitude_deg};
  pose.altitude = geo::AltitudeMsl::metres(ownship.altitude_msl_m);
  pose.platform.heading = geo::Bearing::degrees(ownship.heading_deg);
  pose.platform.pitch = geo::Angle::degrees(ownship.pitch_deg);
  pose.platform.roll = geo::Angle::degrees(ownship.roll_deg);
  pose.platform.ground_track = databuffer::ground_track_of(ownship);
  pose.ground_speed = geo::Speed::metres_per_second(std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps));
  pose.velocity_mps = {ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps};
  return pose;
}

radar::MapViewpoint viewpoint_of(const Pose& pose) {
  return {pose.place, pose.platform.heading, pose.platform.ground_track};
}

bool asks_for_video(const databuffer::RadarCommand& command) {
  const bool scans = command.mode == static_cast<std::uint8_t>(radar::Mode::rbm) ||
                     command.mode == static_cast<std::uint8_t>(radar::Mode::hrm) ||
                     command.mode == static_cast<std::uint8_t>(radar::Mode::beacon);
  return command.power == static_cast<std::uint8_t>(radar::Power::operate) && scans &&
         command.range_nm >= kLeastRangeNm && command.range_nm <= kGreatestRangeNm;
}

}  // namespace yars::model::kernel
