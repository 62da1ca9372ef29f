#include "station/instructor_map.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/key_map.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::station {

namespace {

constexpr std::string_view kBegin = "/map/", kEnd = ".png";

// Takes a whole number and what follows it, `end`, from the text.
std::optional<int> take_number(std::string_view& text, std::string_view end) {
  int number = 0;
  const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  if (!text.starts_with(end)) return std::nullopt;
  text.remove_prefix(end.size());
  return number;
}

double edge_deg(int level) {
  return std::ldexp(kTileEdge_deg, -level);
}

}  // namespace

std::optional<MapTile> tile_of_path(std::string_view path) {
  if (!path.starts_with(kBegin)) return std::nullopt;
  path.remove_prefix(kBegin.size());
  const auto level = take_number(path, "/"), row = take_number(path, "/"), column = take_number(path, kEnd);
  if (!level || !row || !column || !path.empty() || *level < 0 || *level > kMaxTileLevel) return std::nullopt;
  const double edge = edge_deg(*level);
  if (*row < 0 || *row * edge >= 180.0 || *column < 0 || *column * edge >= 360.0) return std::nullopt;
  return MapTile{*level, *row, *column};
}

model::terrain::MapFrame frame_of(const MapTile& tile) {
  const double edge = edge_deg(tile.level);
  const double south_deg = -90.0 + tile.row * edge, west_deg = -180.0 + tile.column * edge;
  return {south_deg, south_deg + edge, west_deg, west_deg + edge, kTilePixels, kTilePixels};
}

namespace {

using nlohmann::ordered_json;

ordered_json number_or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json position_json(geo::GeoPoint point) {
  return ordered_json::array({point.latitude_deg, point.longitude_deg});
}

// Corners of a square on the plane of a map, from the far left one clockwise. `apex`: origin of the plane;
// `distance_m` from it to the centre, in the direction `up`.
ordered_json corners_json(geo::GeoPoint apex, geo::Bearing up, double distance_m, double window_m) {
  const geo::AzimuthalEquidistant plane(apex, up);
  const double half_m = 0.5 * window_m;
  ordered_json corners = ordered_json::array();
  for (const auto& [right_m, up_m] : std::array<std::array<double, 2>, 4>{
           {{-half_m, half_m}, {half_m, half_m}, {half_m, -half_m}, {-half_m, -half_m}}})
    corners.push_back(position_json(plane.geodetic_from_plane({right_m, distance_m + up_m})));
  return corners;
}

}  // namespace

ordered_json aircraft_json(const databuffer::ModelStatus& model) {
  if ((model.flags & databuffer::kModelStale) != 0U) return nullptr;
  const auto& own = model.ownship;
  const double speed_mps = std::hypot(own.velocity_north_mps, own.velocity_east_mps);
  return {{"lat", own.latitude_deg},
          {"lon", own.longitude_deg},
          {"alt_ft", own.altitude_msl_m / geo::kMetresPerFoot},
          {"above_ground_ft", number_or_null(model.height_above_ground_m / geo::kMetresPerFoot)},
          {"heading_deg", own.heading_deg},
          {"track_deg", databuffer::ground_track_of(own).degrees()},
          {"speed_kt", geo::Speed::metres_per_second(speed_mps).knots()}};
}

ordered_json scan_json(const databuffer::ModelStatus& model) {
  if ((model.flags & databuffer::kModelStale) != 0U) return nullptr;
  return {{"scanning", (model.flags & databuffer::kModelScanning) != 0U},
          {"frozen", (model.flags & databuffer::kModelFrozen) != 0U},
          {"centre_deg", geo::Bearing::degrees(model.scan_centre_deg).degrees()},
          {"width_deg", model.scan_width_deg},
          {"range_nm", model.scan_range_m / geo::kMetresPerNauticalMile},
          {"beam_deg",
           std::isfinite(model.antenna_azimuth_deg)
               ? ordered_json(geo::Bearing::degrees(model.ownship.heading_deg + model.antenna_azimuth_deg).degrees())
               : ordered_json(nullptr)}};
}

ordered_json patch_json(const databuffer::PatchMap& map) {
  const double window_m = map.window_nm * geo::kMetresPerNauticalMile;
  return {{"id", map.id},
          {"lat", map.latitude_deg},
          {"lon", map.longitude_deg},
          {"window_nm", map.window_nm},
          {"up_deg", map.up_deg},
          {"size", map.size},
          {"corners", corners_json({map.apex_latitude_deg, map.apex_longitude_deg}, geo::Bearing::degrees(map.up_deg),
                                   map.distance_m, window_m)}};
}

ordered_json forming_json(const databuffer::ModelStatus& model) {
  if (!(model.map_window_nm > 0.0)) return nullptr;
  const double window_m = model.map_window_nm * geo::kMetresPerNauticalMile;
  return {{"progress", number_or_null(model.map_progress)},
          {"corners", corners_json({model.map_latitude_deg, model.map_longitude_deg},
                                   geo::Bearing::degrees(model.map_up_deg), 0.0, window_m)}};
}

ordered_json navigators_json(const databuffer::RadarState& state) {
  const auto error = [](const databuffer::NavigatorError& of) {
    return ordered_json{{"north_ft", of.north_m / geo::kMetresPerFoot}, {"east_ft", of.east_m / geo::kMetresPerFoot}};
  };
  return {{"mission", error(state.mission)}, {"ins", error(state.ins)}};
}

ordered_json theatre_json(const radar::RadarConfiguration& configuration, const std::vector<Place>& scenes,
                          const std::vector<geo::GeoPoint>& route) {
  ordered_json theatre{{"radar", configuration.name}, {"fidelity", configuration.fidelity.name}};
  auto& places = theatre["scenes"] = ordered_json::array();
  for (const Place& place : scenes)
    places.push_back(
        {{"name", place.name}, {"lat", place.position.latitude_deg}, {"lon", place.position.longitude_deg}});
  auto& beacons = theatre["beacons"] = ordered_json::array();
  for (const radar::Beacon& beacon : configuration.world.beacons.beacons)
    beacons.push_back({{"name", beacon.name},
                       {"lat", beacon.position.latitude_deg},
                       {"lon", beacon.position.longitude_deg},
                       {"code", beacon.code}});
  auto& waypoints = theatre["route"] = ordered_json::array();
  for (const geo::GeoPoint& point : route) waypoints.push_back(position_json(point));
  auto& keys = theatre["keys"] = ordered_json::array();
  for (const databuffer::KeyHelp& row : databuffer::key_help())
    keys.push_back({{"keys", row.keys}, {"does", row.does}});
  return theatre;
}

}  // namespace yars::station
