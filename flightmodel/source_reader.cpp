#include "flightmodel/source_reader.hpp"

#include <algorithm>

#include "flightmodel/motion.hpp"
#include "flightmodel/route_flight.hpp"
#include "flightmodel/track_flight.hpp"
#include "lib/file/text_file.hpp"
#include "lib/text/nearest_word.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"

namespace yars::flightmodel {

error::Expected<FixedSetting> parse_fixed(std::string_view text) {
  const auto numbers = file::parse_numbers("fixed", text::fields_of(text, ','),
                                           {{"LAT", -90.0, 90.0},
                                            {"LON", -180.0, 180.0},
                                            {"ALT_FT", values::Pose::altitude.low, values::Pose::altitude.high},
                                            {"HDG", values::Pose::heading.low, values::Pose::heading.high},
                                            {"KT", 0.0, values::Reposition::speed.high}},
                                           ",");
  if (!numbers) return tl::unexpected(numbers.error());
  const auto& value = *numbers;
  return FixedSetting{{{value[0], value[1]}, geo::AltitudeMsl::feet(value[2]), geo::Bearing::degrees(value[3])},
                      geo::Speed::knots(value[4])};
}

FixedFlight::FixedFlight(const FixedSetting& setting)
    : setting_(setting),
      ground_speed_(setting.ground_speed),
      origin_(setting.start),
      ray_(setting.start.point, setting.start.heading) {}

void FixedFlight::reset() {
  reposition(setting_.start);
  ground_speed_ = setting_.ground_speed;
}

bool FixedFlight::reposition(const Placement& placement) {
  origin_ = placement;
  if (placement.ground_speed) ground_speed_ = *placement.ground_speed;
  ray_ = geo::GeodesicRay(placement.point, placement.heading);
  flown_ = geo::Length();
  return true;
}

FlightSample FixedFlight::step(geo::Duration dt) {
  const auto motion_here = [this] {
    const auto end = ray_.position_and_azimuth(flown_);
    return Motion{end.point, origin_.altitude, end.azimuth, ground_speed_, {}};
  };
  const Motion before = motion_here();
  const auto flown = geo::Length::metres(ground_speed_.metres_per_second() * forward_step(dt).seconds());
  flown_ = flown_ + surface_distance(before, flown);
  const Motion motion = motion_here();
  return sample_of(motion, coordinated_attitude(motion, {}), "fixed");
}

namespace {

using error::Expected;

constexpr std::string_view kForms =
    "route:FILE, fixed:LAT,LON,ALT_FT,HDG,KT, csv:FILE, flightgear:PORT, jsbsim:PORT, xplane:HOST:PORT or dis:PORT";

Expected<FlightSource> open_fixed(std::string_view setting) {
  auto parsed = parse_fixed(setting);
  if (!parsed) return tl::unexpected(error::usage_error(parsed.error()));
  return FlightSource{std::make_unique<FixedFlight>(*parsed), "fixed:" + std::string(setting)};
}

Expected<FlightSource> open_route(std::string_view file) {
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  auto route = parse_route(*text, file);
  if (!route) return tl::unexpected(route.error());
  const std::string length = text::counted(route->waypoints.size(), "waypoint") + (route->loop ? ", looped" : "");
  return FlightSource{std::make_unique<RouteFlight>(*std::move(route)), "route " + std::string(file) + ", " + length};
}

Expected<FlightSource> open_track(std::string_view file) {
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  auto track = parse_track(*text, file);
  if (!track) return tl::unexpected(track.error());
  const std::string length = text::counted(track->rows.size(), "row") + (track->loop ? ", looped" : "");
  return FlightSource{std::make_unique<TrackFlight>(*std::move(track)), "track " + std::string(file) + ", " + length};
}

}  // namespace

Expected<FlightSource> open_source(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view kind = text.substr(0, colon);
  const std::string_view rest = text.substr(std::min(colon + 1, text.size()));
  if (kind == "fixed") return open_fixed(rest);
  if (kind == "route" && !rest.empty()) return open_route(rest);
  if (kind == "csv" && !rest.empty()) return open_track(rest);
  static const std::vector<std::string> kKinds{"route:", "fixed:", "csv:", "flightgear:", "jsbsim:", "xplane:", "dis:"};
  const std::string named = std::string(kind) + ':';
  const bool is_known = std::ranges::find(kKinds, named) != kKinds.end();  // a known kind without its argument
  return tl::unexpected(error::usage_error("--source", std::string(kForms), '"' + std::string(text) + '"',
                                           is_known ? "" : text::did_you_mean(named, kKinds)));
}

}  // namespace yars::flightmodel
