#include "radar/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::radar {

namespace {

constexpr const char* kForce = "or give `force=true` to ignore the limit";
// [deg] A message proposes a heading with this angle between ground track and target, clamped to the limits. The margin
// keeps the proposed heading within the limits when it is rounded to an integer.
constexpr double kProposedOffTrack_deg = 45.0;
constexpr double kHeadingMargin_deg = 1.0;

std::string number(double value, int decimals) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

// At most two decimals, without trailing zeros: 0.67, 3.3, 80.
std::string short_number(double value) {
  std::string text = number(value, 2);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string list_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + short_number(value);
  return text;
}

// Platform in level flight along the ground track.
Platform level_flight(const model::hrm::PatchOrder& order) {
  return {order.ground_track, {}, {}, order.ground_track};
}

// Advice on a heading that puts the target between blind zone and gimbal limit, on the same side as now.
// `off_track_deg`: angle from the ground track to the target, right positive.
std::string proposed_heading(const geo::GeodesicInverse& to_target, double off_track_deg, const MapLimits& limits) {
  const double min_deg = limits.blind_zone_deg + kHeadingMargin_deg;
  const double max_deg = std::min(limits.antenna.azimuth_limit_deg, 180.0 - limits.blind_zone_deg) - kHeadingMargin_deg;
  if (min_deg > max_deg) return "no heading is possible: the configured gimbal limits lie within the blind zone";
  const double side = off_track_deg < 0.0 ? 1.0 : -1.0;
  const double off_deg = std::clamp(kProposedOffTrack_deg, min_deg, max_deg);
  const geo::Bearing heading = to_target.azimuth_at_start + geo::Angle::degrees(side * off_deg);
  return "give `heading_deg=" + number(std::fmod(std::round(heading.degrees()) + 360.0, 360.0), 0) + "`";
}

Error blind_zone_error(const geo::GeodesicInverse& to_target, double off_deg, const MapLimits& limits) {
  return {"BLIND ZONE",
          "a target " + short_number(limits.blind_zone_deg) + " to " + short_number(180.0 - limits.blind_zone_deg) +
              " deg off the ground track",
          "one " + number(std::abs(off_deg), 1) + " deg off it",
          proposed_heading(to_target, off_deg, limits) + ", " + kForce, ErrorCode::limit};
}

Error gimbal_error(const geo::GeodesicInverse& to_target, double off_deg, const MapLimits& limits) {
  return {"GIMBAL", "a target within " + short_number(limits.antenna.azimuth_limit_deg) + " deg of the nose",
          "one " + number(std::abs(off_deg), 1) + " deg " + (off_deg < 0.0 ? "left" : "right") + " of it",
          proposed_heading(to_target, off_deg, limits) + ", " + kForce, ErrorCode::limit};
}

Error depression_error(geo::Angle elevation, const MapLimits& limits) {
  return {"GIMBAL", "a target at most " + short_number(limits.antenna.elevation_limit_deg) + " deg below the horizon",
          "one " + number(-elevation.degrees(), 1) + " deg below it",
          std::string("fly lower or farther away, ") + kForce, ErrorCode::limit};
}

Error window_error(std::string_view reason, const geo::GeodesicInverse& to_target, geo::Length window,
                   const WindowLimits& table) {
  const auto limits = cursor_limits(window, table);
  const std::string side = short_number(window.nautical_miles());
  if (!limits)
    return {std::string(reason), "a window of the radar: " + list_of(table.windows_nm) + " NM", side + " NM",
            std::string("give one of these as `window_nm`, ") + kForce, ErrorCode::limit};
  return {std::string(reason),
          "for a window of " + side + " NM a target " + short_number(limits->min.nautical_miles()) + " to " +
              short_number(limits->max.nautical_miles()) + " NM away",
          number(to_target.distance.nautical_miles(), 2) + " NM",
          std::string("move the aircraft or give another `window_nm`, ") + kForce, ErrorCode::limit};
}

}  // namespace

std::optional<Error> beyond_limits(const model::hrm::PatchOrder& order, const MapLimits& limits,
                                   std::optional<double> target_ground_m) {
  const auto reason = map_rejection({order.apex, order.altitude, level_flight(order)}, {order.centre, target_ground_m},
                                    {order.window}, limits);
  if (!reason) return std::nullopt;
  const geo::GeodesicInverse to_target = geo::geodesic_inverse(order.apex, order.centre);
  const double off_deg = (to_target.azimuth_at_start - order.ground_track).degrees();
  if (*reason == "BLIND ZONE") return blind_zone_error(to_target, off_deg, limits);
  if (*reason != "GIMBAL") return window_error(*reason, to_target, order.window, limits.windows);
  if (!target_ground_m || std::abs(off_deg) > limits.antenna.azimuth_limit_deg)
    return gimbal_error(to_target, off_deg, limits);
  return depression_error(elevation_to_ground(order.altitude, to_target.distance, *target_ground_m), limits);
}

std::optional<Error> beyond_gimbal(geo::Angle elevation, geo::Angle width, const AntennaConfiguration& antenna) {
  const auto broken = [](const char* option, double min_deg, double max_deg, geo::Angle found) {
    return Error{option,
                 short_number(min_deg) + " to " + short_number(max_deg) + " deg, the configured gimbal limits",
                 short_number(found.degrees()) + " deg",
                 std::string("give an angle within them, ") + kForce,
                 ErrorCode::limit,
                 min_deg,
                 max_deg};
  };
  const double steepest_deg = antenna.elevation_limit_deg, widest_deg = 2.0 * antenna.azimuth_limit_deg;
  if (std::abs(elevation.degrees()) > steepest_deg)
    return broken("elevation_deg", -steepest_deg, steepest_deg, elevation);
  if (width.degrees() > widest_deg) return broken("width_deg", 0.0, widest_deg, width);
  return std::nullopt;
}

std::optional<Error> beneath_ground(geo::AltitudeMsl altitude, double ground_m) {
  if (!(altitude.metres() < ground_m)) return std::nullopt;
  return Error{
      "altitude_ft",
      "an aircraft above the ground, which is at " + number(geo::Length::metres(ground_m).feet(), 0) + " ft there",
      number(geo::Length::metres(altitude.metres()).feet(), 0) + " ft", std::string("fly higher, ") + kForce,
      ErrorCode::limit};
}

namespace {

// The field of a request that a text names; null: none.
const values::Field* field_named(std::string_view name) {
  for (const std::span<const values::Field> fields : values::kRequests)
    for (const values::Field& field : fields)
      if (field.name == name) return &field;
  return nullptr;
}

// The text with each `NAME` or `NAME=VALUE` of a field replaced by what `spell` returns for it.
std::string spelled_text(const std::string& text, const Spell& spell) {
  std::string changed;
  std::size_t at = 0;
  while (true) {
    const std::size_t open = text.find('`', at);
    const std::size_t close = open == std::string::npos ? open : text.find('`', open + 1);
    if (close == std::string::npos) return changed + text.substr(at);
    const std::string_view inside = std::string_view(text).substr(open + 1, close - open - 1);
    const std::size_t equals = inside.find('=');
    const values::Field* const field = field_named(inside.substr(0, equals));
    changed += text.substr(at, open - at);
    changed += field == nullptr ? text.substr(open, close + 1 - open)
                                : spell(*field, equals == std::string_view::npos ? "" : inside.substr(equals + 1));
    at = close + 1;
  }
}

}  // namespace

Error beyond_field(std::string subject, const values::Field& field, double found) {
  const std::string unit = field.unit.empty() ? "" : ' ' + std::string(field.unit);
  return {std::move(subject),
          text::text_of_number(field.low) + " to " + text::text_of_number(field.high) + unit,
          text::text_of_number(found),
          "",
          ErrorCode::range,
          field.low,
          field.high};
}

Error spelled(Error error, const Spell& spell) {
  // A subject is one name, or several with a comma between them.
  std::string subject;
  for (std::string_view rest = error.subject; !rest.empty();) {
    const std::string_view name = rest.substr(0, rest.find(", "));
    const values::Field* const field = field_named(name);
    subject += (subject.empty() ? "" : ", ") + (field == nullptr ? std::string(name) : spell(*field, ""));
    rest.remove_prefix(std::min(rest.size(), name.size() + 2));
  }
  error.subject = std::move(subject);
  error.expected = spelled_text(error.expected, spell);
  error.action = spelled_text(error.action, spell);
  return error;
}

}  // namespace yars::radar
