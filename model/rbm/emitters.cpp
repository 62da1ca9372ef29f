#include "model/rbm/emitters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/radar/modes.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kMast_m = 10.0;         // height above ground of an emitter without a configured altitude
constexpr double kMinDistance_m = 10.0;  // lower limit of an emitter's distance, so that its power is finite

// True if the jammer jams the radar's band and channel.
bool is_jammed(const radar::Jammer& jammer, const physics::SweepGeometry& geometry) {
  const bool band = jammer.band == radar::kEveryBand || jammer.band == static_cast<int>(geometry.band);
  const auto channel = static_cast<double>(geometry.channel);
  return band && std::find(jammer.channels.begin(), jammer.channels.end(), channel) != jammer.channels.end();
}

// [m MSL] The configured altitude, or the top of a mast on the ground if the altitude is NaN. Ground of unknown
// elevation counts as 0 m.
double altitude_of(double configured_m, geo::GeoPoint position, const terrain::TerrainView& terrain) {
  if (!std::isnan(configured_m)) return configured_m;
  const double ground_m = terrain.elevation_m(position);
  return (std::isnan(ground_m) ? 0.0 : ground_m) + kMast_m;
}
}  // namespace

Strobes::Strobes(const physics::RadarParameters& parameters)
    : jamming_(std::make_shared<const radar::JammingConfiguration>(parameters.world.jamming)),
      beam_(parameters.beam),
      geometry_parameters_(parameters.geometry),
      receivers_(parameters),
      gas_(parameters) {}

double Strobes::level(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  const radar::JammingConfiguration& jamming = *jamming_;
  if (jamming.jammers.empty()) return 0.0;
  const physics::Receiver receiver = receivers_.at(geometry.range);
  const double radar_w = physics::ratio(jamming.radar_power_dbw);
  const double sidelobe = physics::ratio(jamming.sidelobe_db);
  double total = 0.0;
  for (const radar::Jammer& jammer : jamming.jammers) {
    if (!is_jammed(jammer, geometry)) continue;
    geo::GeodesicInverse path = geo::geodesic_inverse(geometry.apex, jammer.position);
    path.distance = std::max(path.distance, geo::Length::metres(kMinDistance_m));
    const double altitude_m = altitude_of(jammer.altitude_m, jammer.position, terrain);
    if (!sight_line_.clear(geometry_parameters_, geometry, terrain, path, altitude_m)) continue;
    const physics::EffectiveEarth earth =
        physics::effective_earth(geometry_parameters_, geometry.apex, path.azimuth_at_start);
    const physics::Sight sight = earth.sight(geometry.altitude.metres(), path.distance.metres(), altitude_m);
    const double two_way =
        physics::azimuth_gain(receiver.azimuth_beamwidth_rad, (path.azimuth_at_start - geometry.azimuth).radians()) *
        physics::two_way_gain(beam_, receiver.elevation_beamwidth_rad, geometry.elevation.radians(),
                              sight.elevation_rad);
    const double loss =
        gas_.one_way_transmission(earth, geometry.altitude.metres(), path.distance.metres(), altitude_m);
    const double gain = loss * std::max(std::sqrt(two_way), sidelobe);
    total += 4.0 * std::numbers::pi * jammer.power_w / radar_w * gain / (sight.slant_range_m * sight.slant_range_m);
  }
  return total / receiver.full_scale;
}

namespace {

// Fraction [0, 1] of the sample number `sample` that a pulse centred at sample `middle` covers.
double covered(double sample, double middle, double pulse_samples) {
  const double half = 0.5 * pulse_samples;
  return std::clamp(std::min(sample + 0.5, middle + half) - std::max(sample - 0.5, middle - half), 0.0, 1.0);
}
}  // namespace

Beacons::Beacons(const physics::RadarParameters& parameters)
    : radar_power_dbw_(parameters.world.jamming.radar_power_dbw),
      beam_(parameters.beam),
      geometry_parameters_(parameters.geometry),
      receivers_(parameters),
      gas_(parameters),
      distance_m_(parameters.samples) {
  const radar::BeaconConfiguration& settings = parameters.world.beacons;
  std::vector<radar::Beacon> answering;
  for (const radar::Beacon& beacon : settings.beacons) {
    if (beacon.code == settings.code) answering.push_back(beacon);
  }
  replies_.reserve(answering.size() * radar::kMaxReplies);
  answering_ = std::make_shared<const std::vector<radar::Beacon>>(std::move(answering));
}

bool Beacons::none() const {
  return answering_->empty();
}

std::span<const Reply> Beacons::replies(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  replies_.clear();
  if (none()) return {};
  const physics::Receiver receiver = receivers_.at(geometry.range);
  for (const radar::Beacon& beacon : *answering_) answer(beacon, geometry, receiver, terrain);
  return replies_;
}

void Beacons::answer(const radar::Beacon& beacon, const physics::SweepGeometry& geometry,
                     const physics::Receiver& receiver, const terrain::TerrainView& terrain) {
  geo::GeodesicInverse path = geo::geodesic_inverse(geometry.apex, beacon.position);
  path.distance = std::max(path.distance, geo::Length::metres(kMinDistance_m));
  const double distance_m = path.distance.metres();
  const double offset_rad = (path.azimuth_at_start - geometry.azimuth).radians();
  // A reply appears no nearer than its beacon. So no reply of a beacon beyond the selected range is visible.
  if (distance_m >= geometry.range.metres() || std::abs(offset_rad) > 0.5 * receiver.azimuth_beamwidth_rad) return;
  const double altitude_m = altitude_of(beacon.altitude_m, beacon.position, terrain);
  if (!sight_line_.clear(geometry_parameters_, geometry, terrain, path, altitude_m)) return;

  const physics::EffectiveEarth earth =
      physics::effective_earth(geometry_parameters_, geometry.apex, path.azimuth_at_start);
  const physics::Sight sight = earth.sight(geometry.altitude.metres(), distance_m, altitude_m);
  const double two_way =
      physics::azimuth_gain(receiver.azimuth_beamwidth_rad, offset_rad) *
      physics::two_way_gain(beam_, receiver.elevation_beamwidth_rad, geometry.elevation.radians(), sight.elevation_rad);
  const double radar_w = physics::ratio(radar_power_dbw_);
  const double loss = gas_.one_way_transmission(earth, geometry.altitude.metres(), distance_m, altitude_m);
  const double power = 4.0 * std::numbers::pi * beacon.power_w / radar_w * loss * std::sqrt(two_way) /
                       (sight.slant_range_m * sight.slant_range_m) / receiver.full_scale;
  for (int reply = 0; reply < std::min(beacon.replies, radar::kMaxReplies); ++reply) {
    const double reply_delay_us = beacon.delay_us + reply * beacon.spacing_us;
    const double slant_range_m = sight.slant_range_m + reply_delay_us * physics::kMetresPerMicrosecond;
    replies_.push_back(
        {slant_range_m, earth.distance_at_slant_range(geometry.altitude.metres(), altitude_m, slant_range_m), power});
  }
}

void Beacons::measure(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain,
                      std::span<float> power) {
  std::fill(power.begin(), power.end(), 0.0F);
  const std::span<const Reply> arrived = replies(geometry, terrain);
  if (arrived.empty()) return;
  const physics::EffectiveEarth earth = physics::effective_earth(geometry_parameters_, geometry.apex, geometry.azimuth);
  physics::sample_distances(geometry_parameters_, earth, geometry, terrain, distance_m_);
  const double spacing_m = geometry.range.metres() / static_cast<double>(power.size());
  const double pulse_samples = physics::point_smear_gain(receivers_.pulse_length(geometry.range).metres() / spacing_m);
  for (const Reply& reply : arrived) {
    const std::size_t middle = physics::nearest_sample(distance_m_, reply.distance_m);
    const double displayed_range_m = geometry_parameters_.slant_range ? reply.slant_range_m : reply.distance_m;
    if (!(displayed_range_m < geometry.range.metres()) || middle >= power.size()) continue;
    const auto reach = static_cast<std::size_t>(std::ceil(0.5 * pulse_samples));
    const std::size_t end = std::min(middle + reach + 1, power.size());
    for (std::size_t i = middle - std::min(middle, reach); i < end; ++i) {
      const double fraction = covered(static_cast<double>(i), static_cast<double>(middle), pulse_samples);
      power[i] += static_cast<float>(fraction * reply.power);
    }
  }
}

}  // namespace yars::model::rbm
