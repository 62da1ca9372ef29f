#include "tools/trade/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lib/file/text_file.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/values/fields.hpp"
#include "yars/requests.hpp"

namespace yars::tools::trade {

namespace {

// Parses a comma-separated list with one number for each field. Errors are of bad usage and name `subject`.
error::Expected<std::vector<double>> numbers_of(std::string_view list, const char* subject,
                                                const std::vector<file::NumberField>& fields) {
  auto numbers = file::parse_numbers(subject, text::fields_of(list, ','), fields, ",");
  if (!numbers) return tl::unexpected(error::usage_error(numbers.error()));
  return numbers;
}

file::NumberField named(std::string_view name, const values::Field& field) {
  return {name, field.low, field.high};
}

// At most six significant digits, without trailing zeros.
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

}  // namespace

error::Expected<Scene> scene_of(std::string_view text) {
  using Of = values::ScanRequest;
  const auto values =
      numbers_of(text, "scene",
                 {named("LAT", Of::latitude), named("LON", Of::longitude), named("ALT_FT", Of::altitude),
                  named("HDG", Of::heading), named("RANGE_NM", Of::range)});
  if (!values) return tl::unexpected(values.error());
  return Scene{{(*values)[0], (*values)[1]}, (*values)[2], (*values)[3], (*values)[4]};
}

std::string scene_name(const Scene& scene) {
  return short_number(scene.position.latitude_deg) + " " + short_number(scene.position.longitude_deg) + " " +
         short_number(scene.altitude_ft) + " ft " + short_number(scene.heading_deg) + " deg " +
         short_number(scene.range_nm) + " NM";
}

model::kernel::ScanRequest request_of(const Scene& scene, geo::Angle width,
                                      const radar::AntennaConfiguration& antenna) {
  model::kernel::ScanRequest request;
  request.pose.position = scene.position;
  request.pose.altitude = geo::AltitudeMsl::feet(scene.altitude_ft);
  request.pose.platform.heading = geo::Bearing::degrees(scene.heading_deg);
  request.pose.platform.ground_track = request.pose.platform.heading;
  request.pose.ground_speed = geo::Speed::knots(yars::ScanRequest().speed_kt);
  request.range = geo::Length::nautical_miles(scene.range_nm);
  request.width = width;
  const double down_deg = std::atan2(-request.pose.altitude.metres(), request.range.metres()) / geo::kRadiansPerDegree;
  request.elevation = geo::Angle::degrees(std::clamp(down_deg, -antenna.elevation_limit_deg, 0.0));
  return request;
}

namespace {

double distance_nm(const MapView& view) {
  return geo::geodesic_inverse(view.position, view.target).distance.nautical_miles();
}

}  // namespace

error::Expected<MapView> map_view_of(std::string_view text) {
  using Of = values::PatchRequest;
  const auto values = numbers_of(text, "view",
                                 {named("LAT", Of::latitude), named("LON", Of::longitude),
                                  named("ALT_FT", Of::altitude), named("TARGET_LAT", Of::target_latitude),
                                  named("TARGET_LON", Of::target_longitude), named("WINDOW_NM", Of::window)});
  if (!values) return tl::unexpected(values.error());
  const MapView view{{(*values)[0], (*values)[1]}, (*values)[2], {(*values)[3], (*values)[4]}, (*values)[5]};
  if (distance_nm(view) <= view.window_nm)
    return tl::unexpected<error::Error>(error::Error{"view", "a target farther away than the window is wide",
                                                     short_number(distance_nm(view)) + " NM", "",
                                                     error::ErrorCode::argument});
  return view;
}

std::string map_view_name(const MapView& view) {
  return short_number(view.target.latitude_deg) + " " + short_number(view.target.longitude_deg) + " " +
         short_number(view.window_nm) + " NM from " + short_number(distance_nm(view)) + " NM, " +
         short_number(view.altitude_ft) + " ft";
}

MapView view_of_target(geo::GeoPoint target, double distance_nm, double bearing_deg, double altitude_ft,
                       double window_nm) {
  return {geo::geodesic_direct(target, geo::Bearing::degrees(bearing_deg), geo::Length::nautical_miles(distance_nm)),
          altitude_ft, target, window_nm};
}

model::hrm::PatchOrder order_of(const MapView& view) {
  model::hrm::PatchOrder order;
  order.apex = view.position;
  order.altitude = geo::AltitudeMsl::feet(view.altitude_ft);
  order.centre = view.target;
  order.ground_track = geo::geodesic_inverse(view.position, view.target).azimuth_at_start - geo::Angle::degrees(90.0);
  order.ground_speed = geo::Speed::knots(480.0);
  order.window = geo::Length::nautical_miles(view.window_nm);
  order.looks = 1;
  return order;
}

Values values_of(const Cost& cost, const Errors& errors) {
  return {cost.scan_ms,          cost.samples_per_second, cost.terrain_bytes, errors.position_m,
          errors.shadow_percent, errors.power_db,         errors.gray_levels, errors.brightness_db};
}

SceneRow row_of(const Scene& scene) {
  return {scene_name(scene),
          {scene.position.latitude_deg, scene.position.longitude_deg, scene.altitude_ft, scene.heading_deg,
           scene.range_nm}};
}

Values values_of(const MapCost& cost, const MapErrors& errors) {
  return {cost.map_ms,     cost.terrain_bytes, errors.position_m,   errors.shadow_percent,
          errors.power_db, errors.gray_levels, errors.brightness_db};
}

SceneRow row_of(const MapView& view) {
  return {map_view_name(view),
          {view.position.latitude_deg, view.position.longitude_deg, view.altitude_ft, view.target.latitude_deg,
           view.target.longitude_deg, view.window_nm}};
}

}  // namespace yars::tools::trade
