#include "tools/trade/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/trade/fields.hpp"

namespace yars::tools::trade {

namespace {

constexpr std::array<Bounds, 5> kSceneBounds{{{"latitude [deg]", -90.0, 90.0},
                                         {"longitude [deg]", -180.0, 180.0},
                                         {"altitude [ft]", -3000.0, 600000.0},
                                         {"heading [deg]", -360.0, 360.0},
                                         {"range [NM]", 0.1, 1000.0}}};
constexpr double kLowestElevationDeg = -60.0;  // of the antenna, its gimbal's stop

}  // namespace

failure::Expected<Scene> scene_of(std::string_view text) {
  const auto values = numbers_of(text, kSceneBounds, "--scene", "LAT,LON,ALT_FT,HDG,RANGE_NM");
  if (!values) return tl::unexpected(values.error());
  return Scene{{(*values)[0], (*values)[1]}, (*values)[2], (*values)[3], (*values)[4]};
}

std::string scene_name(const Scene& scene) {
  return short_number(scene.place.latitude_deg) + " " + short_number(scene.place.longitude_deg) + " " +
         short_number(scene.altitude_ft) + " ft " + short_number(scene.heading_deg) + " deg " +
         short_number(scene.range_nm) + " NM";
}

model::kernel::ScanRequest request_of(const Scene& scene, geo::Angle width) {
  model::kernel::ScanRequest request;
  request.pose.place = scene.place;
  request.pose.altitude = geo::AltitudeMsl::feet(scene.altitude_ft);
  request.pose.platform.heading = geo::Bearing::degrees(scene.heading_deg);
  request.pose.platform.ground_track = request.pose.platform.heading;
  request.range = geo::Length::nautical_miles(scene.range_nm);
  request.width = width;
  const double down_deg = std::atan2(-request.pose.altitude.metres(), request.range.metres()) / geo::kRadiansPerDegree;
  request.elevation = geo::Angle::degrees(std::clamp(down_deg, kLowestElevationDeg, 0.0));
  return request;
}

}  // namespace yars::tools::trade
