#include "model/rbm/strobes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/rbm/earth.hpp"
#include "model/rbm/receiver.hpp"
#include "model/reflectivity/decibels.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kMastM = 10.0;           // [m] above the ground: a jammer or beacon whose altitude is not given
constexpr double kLeastDistanceM = 10.0;  // [m] keeps one below the aircraft finite

bool is_jammed(const radar::Jammer& jammer, const Look& look) {
  const bool band = jammer.band == radar::kEveryBand || jammer.band == static_cast<int>(look.band);
  const auto channel = static_cast<double>(look.channel);
  return band && std::find(jammer.channels.begin(), jammer.channels.end(), channel) != jammer.channels.end();
}

double ground_m(const terrain::TerrainView& terrain, geo::GeoPoint place) {
  const double elevation_m = terrain.elevation_m(place);
  return std::isnan(elevation_m) ? 0.0 : elevation_m;
}
}  // namespace

double Strobes::level(const Look& look, const terrain::TerrainView& terrain) {
  const radar::JammingConfiguration& jamming = configuration_.world.jamming;
  if (jamming.jammers.empty()) return 0.0;
  const Receiver receiver = make_receiver(configuration_, look.range);
  const double radar_w = reflectivity::ratio(jamming.radar_power_dbw);
  const double sidelobe = reflectivity::ratio(jamming.sidelobe_db);
  double total = 0.0;
  for (const radar::Jammer& jammer : jamming.jammers) {
    if (!is_jammed(jammer, look)) continue;
    geo::GeodesicInverse way = geo::geodesic_inverse(look.apex, jammer.place);
    way.distance = std::max(way.distance, geo::Length::metres(kLeastDistanceM));
    const double altitude_m =
        std::isnan(jammer.altitude_m) ? ground_m(terrain, jammer.place) + kMastM : jammer.altitude_m;
    if (!sight_line_.clear(configuration_.fidelity, look, terrain, way, altitude_m)) continue;
    const EffectiveEarth earth = effective_earth(configuration_.fidelity, look.apex, way.azimuth_at_start);
    const Sight sight = earth.sight(look.altitude.metres(), way.distance.metres(), altitude_m);
    const double two_way =
        azimuth_gain(receiver.azimuth_beamwidth_rad, (way.azimuth_at_start - look.azimuth).radians()) *
        two_way_gain(configuration_.fidelity.beam, receiver.elevation_beamwidth_rad, look.elevation.radians(),
                     sight.elevation_rad);
    const double loss = gas_.one_way_loss(earth, look.altitude.metres(), way.distance.metres(), altitude_m);
    const double gain = loss * std::max(std::sqrt(two_way), sidelobe);
    total += 4.0 * std::numbers::pi * jammer.power_w / radar_w * gain / (sight.slant_range_m * sight.slant_range_m);
  }
  return total / receiver.full_scale;
}

}  // namespace yars::model::rbm
