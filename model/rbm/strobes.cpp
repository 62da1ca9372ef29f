#include "model/rbm/strobes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/rbm/earth.hpp"
#include "model/rbm/receiver.hpp"
#include "model/reflectivity/decibels.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kMastM = 10.0;           // [m] above the ground: a jammer whose altitude is not given
constexpr double kLeastDistanceM = 10.0;  // [m] keeps a jammer below the aircraft finite
constexpr double kProfileStepM = 500.0;   // [m] a ridge narrower than this may be missed
constexpr double kMostSteps = 400.0;

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

bool in_sight(const radar::Fidelity& fidelity, const Look& look, const terrain::TerrainView& terrain,
              const geo::GeodesicInverse& way, double altitude_m) {
  const EffectiveEarth earth = effective_earth(fidelity, look.apex, way.azimuth_at_start);
  const double distance_m = way.distance.metres();
  const double tangent = earth.sight(look.altitude.metres(), distance_m, altitude_m).tangent;
  const geo::GeodesicRay ray(look.apex, way.azimuth_at_start);
  const double steps = std::clamp(std::ceil(distance_m / kProfileStepM), 2.0, kMostSteps);
  for (double step = 1.0; step < steps; step += 1.0) {
    const double there_m = distance_m * step / steps;
    const double height_m = ground_m(terrain, ray.position(geo::Length::metres(there_m)));
    if (earth.sight(look.altitude.metres(), there_m, height_m).tangent >= tangent) return false;
  }
  return true;
}

double Strobes::level(const Look& look, const terrain::TerrainView& terrain) const {
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
    if (!in_sight(configuration_.fidelity, look, terrain, way, altitude_m)) continue;
    const EffectiveEarth earth = effective_earth(configuration_.fidelity, look.apex, way.azimuth_at_start);
    const Sight sight = earth.sight(look.altitude.metres(), way.distance.metres(), altitude_m);
    const double two_way =
        azimuth_gain(receiver.azimuth_beamwidth_rad, (way.azimuth_at_start - look.azimuth).radians()) *
        two_way_gain(configuration_.fidelity.beam, receiver.elevation_beamwidth_rad, look.elevation.radians(),
                     sight.elevation_rad);
    const double gain = std::max(std::sqrt(two_way), sidelobe);
    total += 4.0 * std::numbers::pi * jammer.power_w / radar_w * gain / (sight.slant_range_m * sight.slant_range_m);
  }
  return total / receiver.full_scale;
}

}  // namespace yars::model::rbm
