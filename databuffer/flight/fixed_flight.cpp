#include "databuffer/flight/fixed_flight.hpp"

#include "databuffer/flight/motion.hpp"
#include "databuffer/flight/numbers.hpp"

namespace yars::databuffer::flight {

failure::Expected<FixedSetting> parse_fixed(std::string_view text) {
  const auto numbers = parse_numbers("fixed", fields_of(text, ','),
                                     {{"LAT", -90.0, 90.0},
                                      {"LON", -180.0, 180.0},
                                      {"ALT_FT", -1'000.0, 200'000.0},
                                      {"HDG", 0.0, 360.0},
                                      {"KT", 0.0, 5'000.0}},
                                     ",");
  if (!numbers) return tl::unexpected(numbers.error());
  const auto& value = *numbers;
  return FixedSetting{{{value[0], value[1]}, geo::AltitudeMsl::feet(value[2]), geo::Bearing::degrees(value[3])},
                      geo::Speed::knots(value[4])};
}

FixedFlight::FixedFlight(const FixedSetting& setting)
    : setting_(setting), origin_(setting.start), ray_(setting.start.point, setting.start.heading) {}

void FixedFlight::reset() {
  reposition(setting_.start);
}

bool FixedFlight::reposition(const Placement& placement) {
  origin_ = placement;
  ray_ = geo::GeodesicRay(placement.point, placement.heading);
  flown_ = geo::Length();
  return true;
}

FlightSample FixedFlight::step(geo::Duration dt) {
  const auto motion_here = [this] {
    const auto place = ray_.place(flown_);
    return Motion{place.point, origin_.altitude, place.azimuth, setting_.ground_speed, {}};
  };
  const Motion before = motion_here();
  const auto flown = geo::Length::metres(setting_.ground_speed.metres_per_second() * stretch_ahead(dt).seconds());
  flown_ = flown_ + surface_distance(before, flown);
  const Motion motion = motion_here();
  return sample_of(motion, coordinated_attitude(motion, {}), "fixed");
}

}  // namespace yars::databuffer::flight
