#include "lib/radar/map_formation.hpp"

#include <algorithm>
#include <cmath>

namespace yars::radar {

namespace {
constexpr double kSpeedOfLight_mps = 299792458.0;  // exact

double wavelength_m(const RadarConfiguration& configuration) {
  return kSpeedOfLight_mps / (configuration.receiver.frequency_ghz * 1e9);
}
}  // namespace

geo::Length map_resolution(geo::Length window) {
  return window / kCellsOfMap;
}

int map_strips(geo::Length window, geo::Length slant_range, geo::Angle azimuth_beamwidth) {
  const double swath_m = slant_range.metres() * azimuth_beamwidth.radians();
  constexpr double kMostStrips = 1000.0;  // of a window far wider than any beam; the cap ends it anyway
  return static_cast<int>(std::clamp(std::ceil(window.metres() / swath_m), 1.0, kMostStrips));
}

geo::Duration formation_time(const MapLook& look, const RadarConfiguration& configuration) {
  const HighResolutionConfiguration& map = configuration.high_resolution;
  const double doppler_mps = look.ground_speed.metres_per_second() * std::abs(std::sin(look.squint.radians()));
  const double strip_s = map.broadening * wavelength_m(configuration) * look.slant_range.metres() /
                         (2.0 * doppler_mps * map_resolution(look.window).metres());
  const int strips =
      map_strips(look.window, look.slant_range, geo::Angle::degrees(configuration.antenna.azimuth_beamwidth_deg));
  const double whole_s = strip_s * look.looks * strips;
  // Standing still or looking straight ahead gives infinity, or nothing at all: the cap holds then.
  return geo::Duration::seconds(whole_s < map.formation_cap_s ? whole_s : map.formation_cap_s);
}

bool in_blind_zone(geo::Angle squint, const HighResolutionConfiguration& configuration) {
  // Astern there is as little Doppler spread as ahead.
  const double off_deg = std::abs(geo::wrapped_degrees(squint.degrees()));
  return std::min(off_deg, 180.0 - off_deg) < configuration.blind_zone_deg;
}

geo::Angle sharpened_beamwidth(geo::Angle squint, geo::Speed ground_speed, const RadarConfiguration& configuration) {
  const geo::Angle beam = geo::Angle::degrees(configuration.antenna.azimuth_beamwidth_deg);
  const double doppler_mps = ground_speed.metres_per_second() * std::abs(std::sin(squint.radians()));
  const double sharpened_rad =
      wavelength_m(configuration) / (2.0 * doppler_mps * configuration.high_resolution.dwell_s);
  return sharpened_rad < beam.radians() ? geo::Angle::radians(sharpened_rad) : beam;
}

}  // namespace yars::radar
