#include "lib/radar/world.hpp"

#include <algorithm>
#include <cmath>

namespace yars::radar {

namespace {

// NaN, a value that is not given, equals NaN.
bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool same(geo::GeoPoint a, geo::GeoPoint b) {
  return same(a.latitude_deg, b.latitude_deg) && same(a.longitude_deg, b.longitude_deg);
}

bool same(const RainCell& a, const RainCell& b) {
  return same(a.position, b.position) && same(a.radius_m, b.radius_m) && same(a.rate_mmh, b.rate_mmh) &&
         same(a.top_m, b.top_m);
}

// Names change no echo.
bool same(const Jammer& a, const Jammer& b) {
  return same(a.position, b.position) && same(a.altitude_m, b.altitude_m) && a.band == b.band &&
         a.channels == b.channels && same(a.power_w, b.power_w);
}

bool same(const Mover& a, const Mover& b) {
  return same(a.position, b.position) && same(a.speed_mps, b.speed_mps) && same(a.heading_deg, b.heading_deg) &&
         same(a.cross_section_m2, b.cross_section_m2) && same(a.height_m, b.height_m) &&
         same(a.since.seconds(), b.since.seconds()) && a.echo == b.echo && a.facing_deg == b.facing_deg &&
         a.tilt_deg == b.tilt_deg;
}

template <class Entries>
bool differ(const Entries& before, const Entries& after) {
  return !std::ranges::equal(before, after, [](const auto& a, const auto& b) { return same(a, b); });
}

}  // namespace

WorldChanges changes_between(const WorldConfiguration& before, const WorldConfiguration& after) {
  return {.sea = !same(before.sea.state, after.sea.state) ||
                 !same(before.sea.wind_speed_mps, after.sea.wind_speed_mps) ||
                 !same(before.sea.wind_from_deg, after.sea.wind_from_deg),
          .rain = differ(before.rain.cells, after.rain.cells),
          .jammers = differ(before.jamming.jammers, after.jamming.jammers),
          .movers = differ(before.movers, after.movers)};
}

}  // namespace yars::radar
