// Forms of the configuration language GUF with their slots (schema.hpp): Route, Point, Navigation.
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <vector>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/velocity_beams.hpp"

namespace yars::config {

namespace {

radar::NamedPoint named(const radar::RoutePoint& point) {
  return {radar::point_name(point.name).value_or(radar::PointName{}), point.kind};
}

std::vector<radar::NamedPoint> named_points(const std::vector<radar::RoutePoint>& route) {
  std::vector<radar::NamedPoint> points;
  std::ranges::transform(route, std::back_inserter(points), named);
  return points;
}

std::optional<ConstraintViolation> check_name(const ConfigurationBuilder& builder) {
  const auto name = radar::point_name(builder.point.name);
  if (!name) {
    return ConstraintViolation{"name",
                               "a name of a sequence point: \"2\", \"2.\", \"2.1\" or \"2.01\", number 1 to 100",
                               quoted_text(builder.point.name)};
  }
  const auto route = named_points(builder.radar.route);
  if (route.size() >= radar::kMaxRoutePoints)
    return ConstraintViolation{
        "name", "at most " + std::to_string(radar::kMaxRoutePoints) + " points in a route, offsets included",
        quoted_text(builder.point.name)};
  const radar::NamedPoint* const other = radar::conflict(*name, route);
  if (other == nullptr) return std::nullopt;
  if (other->name == *name)
    return ConstraintViolation{"name", "a name that is not yet in the route", quoted_text(builder.point.name)};
  return ConstraintViolation{"name", "a number that no other steer point or target has",
                             quoted_text(builder.point.name) + " beside " + quoted_text(radar::text_of(other->name))};
}

// Rules of a point: its name is valid and occurs once in the route, and its coordinates are given. Each number belongs
// to one steer point, initial point or target; its offsets have the same number. If the file gives the kind, the name
// fits that kind: a name such as "2" fits a steer point or an initial point, and a name with a dot fits one kind only.
std::optional<ConstraintViolation> check_point(const ConfigurationBuilder& builder) {
  if (auto wrong = check_name(builder)) return wrong;
  if (auto wrong = check_coordinates(builder.point.position)) return wrong;
  if (builder.point_kind == kKindByName) return std::nullopt;
  const radar::PointName name = *radar::point_name(builder.point.name);
  if (radar::is_kind_of(static_cast<radar::PointKind>(builder.point_kind), name)) return std::nullopt;
  return ConstraintViolation{
      "kind",
      "the kind that the name " + builder.point.name + " has, " +
          std::string(radar::kPointKindNames[static_cast<std::size_t>(radar::kind_by_name(name))]),
      std::string(radar::kPointKindNames[static_cast<std::size_t>(builder.point_kind)])};
}

void begin_point(ConfigurationBuilder& builder) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  builder.point = {};
  builder.point.position = {kUnknown, kUnknown};
  builder.point.elevation_m = kUnknown;
  builder.point_kind = kKindByName;
}

void end_point(ConfigurationBuilder& builder) {
  builder.point.kind = builder.point_kind == kKindByName ? radar::kind_by_name(*radar::point_name(builder.point.name))
                                                         : static_cast<radar::PointKind>(builder.point_kind);
  if (builder.point_kind == kKindByName) builder.points_without_kind.insert(builder.point.name);
  builder.radar.route.push_back(builder.point);
}

void clear_route(ConfigurationBuilder& builder) {
  builder.radar.route.clear();
  builder.points_without_kind.clear();
}

// The last steer point before each target becomes an initial point, unless the file states its kind.
void derive_initial_points(ConfigurationBuilder& builder) {
  const auto points = named_points(builder.radar.route);
  for (const radar::NamedPoint& target : points) {
    if (target.kind != radar::PointKind::target) continue;
    const auto index = radar::initial_point_before(target.name.number, points);
    if (!index) continue;
    radar::RoutePoint& point = builder.radar.route[*index];
    if (builder.points_without_kind.contains(point.name)) point.kind = radar::PointKind::initial;
  }
}

FormSchema point() {
  return {.name = "Point",
          .purpose = "a sequence point",
          .slots = {{.name = "name",
                     .binding = TextSlot{YARS_FIELD(point.name)},
                     .purpose = "\"2\", target \"2.\", offset \"2.1\", target offset \"2.01\""},
                    latitude_slot(YARS_FIELD(point.position.latitude_deg)),
                    longitude_slot(YARS_FIELD(point.position.longitude_deg)),
                    entry_slot("elevation", values::WorldPoint::elevation, YARS_FIELD(point.elevation_m)),
                    {.name = "kind",
                     .binding = ChoiceSlot{
                         radar::kPointKindNames, [](const ConfigurationBuilder& builder) { return builder.point_kind; },
                         [](ConfigurationBuilder& builder, int index) { builder.point_kind = index; }},
                     .purpose = "left out: from the name; the last steer point before a target becomes initial"}},
          .part_of_value = true,
          .begin = begin_point,
          .check = check_point,
          .end = end_point,
          .count = [](const ConfigurationBuilder& builder) { return builder.radar.route.size(); },
          .select =
              [](ConfigurationBuilder& builder, std::size_t index) {
                builder.point = builder.radar.route[index];
                builder.point_kind = static_cast<int>(builder.point.kind);
              }};
}

}  // namespace

std::vector<FormSchema> route_forms() {
  return {{.name = "Route",
           .purpose = "the sequence points; replaces an earlier route",
           .slots = {list_slot("points", "Point", clear_route, "at most 100 points, and 256 with their offsets")},
           .end = derive_initial_points},
          point()};
}

namespace {

// Rules: there are as many depressions as azimuths, and the beams do not all lie in one plane.
std::optional<ConstraintViolation> check_beams(const ConfigurationBuilder& builder) {
  const radar::NavigationConfiguration& navigation = builder.radar.navigation;
  const std::size_t azimuths = navigation.beam_azimuths_deg.size();
  const std::size_t depressions = navigation.beam_depressions_deg.size();
  if (azimuths != depressions)
    return ConstraintViolation{"beamDepressions", "as many as beamAzimuths, " + std::to_string(azimuths),
                               std::to_string(depressions)};
  if (radar::horizontal_dilution(navigation.beam_azimuths_deg, navigation.beam_depressions_deg)) return std::nullopt;
  return ConstraintViolation{"beamAzimuths", "beams that do not all lie in one plane", "all in one plane"};
}

}  // namespace

std::vector<FormSchema> navigation_forms() {
  constexpr double kMaxError_ft = 600'000.0;
  constexpr double kMaxDrift_fps = 1'000.0;
  const auto feet = [](double& (*of)(ConfigurationBuilder&)) { return NumberSlot{of, geo::kMetresPerFoot}; };
  return {
      {.name = "Navigation",
       .purpose = "errors of the navigators, and their correction by the radar",
       .slots = {number_slot("errorNorth", "ft", -kMaxError_ft, kMaxError_ft,
                             feet(YARS_FIELD(radar.navigation.error_north_m)),
                             "northward error of both navigators' position at the start of the session"),
                 number_slot("errorEast", "ft", -kMaxError_ft, kMaxError_ft,
                             feet(YARS_FIELD(radar.navigation.error_east_m)), "like errorNorth, eastward"),
                 number_slot("driftNorth", "ft/s", -kMaxDrift_fps, kMaxDrift_fps,
                             feet(YARS_FIELD(radar.navigation.drift_north_mps)),
                             "northward error of both navigators' velocity at the start of the session; their position "
                             "drifts at this speed"),
                 number_slot("driftEast", "ft/s", -kMaxDrift_fps, kMaxDrift_fps,
                             feet(YARS_FIELD(radar.navigation.drift_east_mps)), "like driftNorth, eastward"),
                 number_slot("driftDown", "ft/s", -kMaxDrift_fps, kMaxDrift_fps,
                             feet(YARS_FIELD(radar.navigation.drift_down_mps)),
                             "downward error of both navigators' velocity at the start of the session"),
                 number_slot("velocityWalk", "ft/s", 0, kMaxDrift_fps, feet(YARS_FIELD(radar.navigation.walk_mps)),
                             "random walk of the velocity's error: standard deviation after an hour"),
                 number_slot("updateValidity", "s", 1, 3600, {YARS_FIELD(radar.navigation.update_validity_s)},
                             "time after a cursor move for which the cursor is valid for an INS update"),
                 number_slot("velocityPeriod", "s", 5, 3600, {YARS_FIELD(radar.navigation.velocity_period_s)},
                             "interval of the velocity updates of IPVU and PVU"),
                 number_slot("velocityNoise", "ft/s", 0, 100, feet(YARS_FIELD(radar.navigation.velocity_noise_mps)),
                             "standard deviation of a horizontal velocity component that the radar measures"),
                 {.name = "magneticModel",
                  .binding = TextSlot{YARS_FIELD(radar.navigation.magnetic_model)},
                  .purpose = "model of the earth's magnetic field; left out: the World Magnetic Model; if its data is "
                             "not installed, magneticVariation applies"},
                 {.name = "magneticFolder",
                  .binding = PathSlot{YARS_FIELD(radar.navigation.magnetic_folder)},
                  .purpose = "folder with the data of magneticModel; left out: the default folder of GeographicLib"},
                 number_slot("magneticYear", "a", 1900, 2100, {YARS_FIELD(radar.navigation.magnetic_year)},
                             "date for magneticModel, as a decimal year"),
                 {.name = "beamAzimuths",
                  .unit = "deg",
                  .lowest = -90,
                  .highest = 90,
                  .binding = ListSlot{YARS_FIELD(radar.navigation.beam_azimuths_deg), radar::kMinVelocityBeams,
                                      radar::kMaxVelocityBeams, Order::any},
                  .purpose = "azimuths of the velocity beams, relative to the ground track, in order of use"},
                 {.name = "beamDepressions",
                  .unit = "deg",
                  .lowest = 1,
                  .highest = 90,
                  .binding = ListSlot{YARS_FIELD(radar.navigation.beam_depressions_deg), radar::kMinVelocityBeams,
                                      radar::kMaxVelocityBeams, Order::any},
                  .purpose = "depressions of the velocity beams below the horizon, in the order of beamAzimuths"},
                 number_slot("beamDwell", "s", 0.05, 10, {YARS_FIELD(radar.navigation.beam_dwell_s)},
                             "dwell of the antenna on each beam")},
       .check = check_beams}};
}

}  // namespace yars::config
