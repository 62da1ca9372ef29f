#include "model/rbm/emitters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/radar/fidelity.hpp"
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

namespace {
constexpr double kMaxPlane_m = 1'000'000.0;  // beyond this distance the series of path() is not used
}  // namespace

EmitterSights::EmitterSights(const physics::RadarParameters& parameters, std::vector<Emitter> emitters)
    : exact_(parameters.fidelity.algorithm == radar::Algorithm::reference),
      geometry_parameters_(parameters.geometry),
      gas_(parameters) {
  geometry_parameters_.exact = false;  // as in SightLine
  use_emitters(std::move(emitters));
}

void EmitterSights::use_emitters(std::vector<Emitter> emitters) {
  emitters_ = std::move(emitters);
  sights_.assign(emitters_.size(), {});
  origin_ = {};
  ecef_.clear();
  ecef_.reserve(emitters_.size());
  for (const Emitter& emitter : emitters_)
    ecef_.push_back(geo::ecef_from_geodetic(emitter.position, geo::HeightAboveEllipsoid::metres(0.0)));
}

EmitterSights::Sight EmitterSights::sight_of(const Emitter& emitter, const physics::SweepGeometry& geometry,
                                             const terrain::TerrainView& terrain) {
  geo::GeodesicInverse path = geo::geodesic_inverse(geometry.apex, emitter.position);
  path.distance = std::max(path.distance, geo::Length::metres(kMinDistance_m));
  const double distance_m = path.distance.metres();
  const physics::EffectiveEarth earth =
      physics::effective_earth(geometry_parameters_, geometry.apex, geometry.altitude, path.azimuth_at_start);
  Sight sight{false,
              altitude_of(emitter.altitude_m, emitter.position, terrain),
              1.0,
              distance_m,
              geo::radius_of_curvature(geometry.apex.latitude_deg, path.azimuth_at_start).metres(),
              earth};
  sight.clear = sight_line_.clear(geometry_parameters_, geometry, terrain, path, sight.altitude_m);
  sight.transmission = gas_.one_way_transmission(earth, geometry.altitude.metres(), distance_m, sight.altitude_m);
  return sight;
}

std::span<const EmitterSights::Sight> EmitterSights::from(const physics::SweepGeometry& geometry,
                                                          const terrain::TerrainView& terrain) {
  const auto sea_level = geo::HeightAboveEllipsoid::metres(0.0);
  const geo::LocalTangentFrame level(geometry.apex, sea_level);
  const double sine = std::sin(geometry.azimuth.radians()), cosine = std::cos(geometry.azimuth.radians());
  apex_ = geometry.apex;
  azimuth_ = geometry.azimuth;
  apex_ecef_ = geo::ecef_from_geodetic(geometry.apex, sea_level);
  ahead_ = level.ecef_from_enu_direction({sine, cosine, 0.0});
  right_ = level.ecef_from_enu_direction({cosine, -sine, 0.0});
  const SightOrigin origin(geometry, terrain, exact_);
  if (origin == origin_) return sights_;
  origin_ = origin;
  const physics::SweepGeometry there = origin.moved(geometry, terrain);
  for (std::size_t i = 0; i < emitters_.size(); ++i) sights_[i] = sight_of(emitters_[i], there, terrain);
  return sights_;
}

EmitterSights::Path EmitterSights::path(std::size_t number) const {
  const Sight& sight = sights_[number];
  if (exact_ || sight.distance_m > kMaxPlane_m) {
    const geo::GeodesicInverse path = geo::geodesic_inverse(apex_, emitters_[number].position);
    return {(path.azimuth_at_start - azimuth_).radians(), std::max(path.distance.metres(), kMinDistance_m)};
  }
  const geo::Vector3 to_emitter = ecef_[number] - apex_ecef_;
  const double ahead_m = dot(to_emitter, ahead_), right_m = dot(to_emitter, right_);
  const double plane2 = ahead_m * ahead_m + right_m * right_m;
  const double arc = physics::arc_per_plane(plane2, sight.radius_of_curvature_m);
  return {std::atan2(right_m, ahead_m), std::max(std::sqrt(plane2) * arc, kMinDistance_m)};
}

namespace {
std::vector<EmitterSights::Emitter> emitters_of(const radar::JammingConfiguration& jamming) {
  std::vector<EmitterSights::Emitter> emitters;
  emitters.reserve(jamming.jammers.size());
  for (const radar::Jammer& jammer : jamming.jammers) emitters.push_back({jammer.position, jammer.altitude_m});
  return emitters;
}

// Squared slant range: law of cosines in the triangle aircraft, centre of the earth, point.
double slant_square(const physics::EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) {
  const double above_m = altitude_m - height_m;
  const double curvature = earth.curvature();
  const double half_rad = 0.5 * distance_m * curvature;
  // Chord of the sphere, and its growth with both heights.
  const double chord_m = half_rad > 0.0 ? 2.0 * std::sin(half_rad) / curvature : distance_m;
  return above_m * above_m + chord_m * chord_m * (1.0 + altitude_m * curvature) * (1.0 + height_m * curvature);
}
}  // namespace

Strobes::Strobes(const physics::RadarParameters& parameters)
    : jamming_(std::make_shared<const radar::JammingConfiguration>(parameters.world.jamming)),
      beam_(parameters.beam),
      sidelobe_(physics::ratio(parameters.world.jamming.sidelobe_db)),
      receivers_(parameters),
      sights_(parameters, emitters_of(parameters.world.jamming)) {}

void Strobes::use_jammers(const physics::RadarParameters& parameters) {
  jamming_ = std::make_shared<const radar::JammingConfiguration>(parameters.world.jamming);
  sights_.use_emitters(emitters_of(*jamming_));
}

double Strobes::level(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  const radar::JammingConfiguration& jamming = *jamming_;
  if (jamming.jammers.empty()) return 0.0;
  const physics::Receiver receiver = receivers_.at(geometry.range);
  const std::span<const EmitterSights::Sight> sights = sights_.from(geometry, terrain);
  double total = 0.0;
  for (std::size_t i = 0; i < sights.size(); ++i)
    if (sights[i].clear && is_jammed(jamming.jammers[i], geometry))
      total += jamming.jammers[i].power_w * received(i, sights[i], geometry, receiver);
  return 4.0 * std::numbers::pi * total / physics::ratio(jamming.radar_power_dbw) / receiver.full_scale;
}

// One-way gain times gas attenuation / R^2.
double Strobes::received(std::size_t number, const EmitterSights::Sight& sight, const physics::SweepGeometry& geometry,
                         const physics::Receiver& receiver) const {
  const EmitterSights::Path path = sights_.path(number);
  const double altitude_m = geometry.altitude.metres();
  const double azimuth_gain = physics::azimuth_gain(receiver.azimuth_beamwidth_rad, path.offset_rad);
  const double square = slant_square(sight.earth, altitude_m, path.distance_m, sight.altitude_m);
  double gain = sidelobe_;
  // Elsewhere the sidelobe is the greater gain, because the gain in elevation is at most 1.
  if (azimuth_gain > sidelobe_ * sidelobe_) {
    const physics::Sight line = sight.earth.sight(altitude_m, path.distance_m, sight.altitude_m);
    const double elevation_gain = physics::two_way_gain(beam_, receiver.elevation_beamwidth_rad,
                                                        geometry.elevation.radians(), line.elevation_rad);
    gain = std::max(std::sqrt(azimuth_gain * elevation_gain), sidelobe_);
  }
  return gain * sight.transmission / square;
}

namespace {

// Fraction [0, 1] of the sample number `sample` that a pulse centred at sample `middle` covers.
double covered(double sample, double middle, double pulse_samples) {
  const double half = 0.5 * pulse_samples;
  return std::clamp(std::min(sample + 0.5, middle + half) - std::max(sample - 0.5, middle - half), 0.0, 1.0);
}

std::vector<radar::Beacon> answering(const radar::BeaconConfiguration& settings) {
  std::vector<radar::Beacon> found;
  for (const radar::Beacon& beacon : settings.beacons)
    if (beacon.code == settings.code) found.push_back(beacon);
  return found;
}

std::vector<EmitterSights::Emitter> emitters_of(const std::vector<radar::Beacon>& beacons) {
  std::vector<EmitterSights::Emitter> emitters;
  emitters.reserve(beacons.size());
  for (const radar::Beacon& beacon : beacons) emitters.push_back({beacon.position, beacon.altitude_m});
  return emitters;
}
}  // namespace

Beacons::Beacons(const physics::RadarParameters& parameters)
    : radar_power_dbw_(parameters.world.jamming.radar_power_dbw),
      beam_(parameters.beam),
      geometry_parameters_(parameters.geometry),
      receivers_(parameters),
      answering_(std::make_shared<const std::vector<radar::Beacon>>(answering(parameters.world.beacons))),
      sights_(parameters, emitters_of(*answering_)) {
  replies_.reserve(answering_->size() * radar::kMaxReplies);
}

bool Beacons::none() const {
  return answering_->empty();
}

std::span<const Reply> Beacons::replies(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  replies_.clear();
  if (none()) return {};
  const physics::Receiver receiver = receivers_.at(geometry.range);
  const std::span<const EmitterSights::Sight> sights = sights_.from(geometry, terrain);
  for (std::size_t i = 0; i < sights.size(); ++i)
    if (sights[i].clear) answer(i, sights[i], geometry, receiver);
  return replies_;
}

void Beacons::answer(std::size_t number, const EmitterSights::Sight& beacon_sight,
                     const physics::SweepGeometry& geometry, const physics::Receiver& receiver) {
  const radar::Beacon& beacon = (*answering_)[number];
  const auto [offset_rad, distance_m] = sights_.path(number);
  // A reply appears no nearer than its beacon. So no reply of a beacon beyond the selected range is visible.
  if (distance_m >= geometry.range.metres() || std::abs(offset_rad) > 0.5 * receiver.azimuth_beamwidth_rad) return;
  const double altitude_m = beacon_sight.altitude_m;
  const physics::EffectiveEarth& earth = beacon_sight.earth;
  const physics::Sight sight = earth.sight(geometry.altitude.metres(), distance_m, altitude_m);
  const double two_way =
      physics::azimuth_gain(receiver.azimuth_beamwidth_rad, offset_rad) *
      physics::two_way_gain(beam_, receiver.elevation_beamwidth_rad, geometry.elevation.radians(), sight.elevation_rad);
  const double radar_w = physics::ratio(radar_power_dbw_);
  const double power = 4.0 * std::numbers::pi * beacon.power_w / radar_w * beacon_sight.transmission *
                       std::sqrt(two_way) / (sight.slant_range_m * sight.slant_range_m) / receiver.full_scale;
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
  const double spacing_m = geometry.range.metres() / static_cast<double>(power.size());
  // A reply is drawn in one sample at least.
  const double pulse_samples = std::max(1.0, receivers_.pulse_length(geometry.range).metres() / spacing_m);
  for (const Reply& reply : arrived) {
    const double displayed_range_m = geometry_parameters_.slant_range ? reply.slant_range_m : reply.distance_m;
    if (!(displayed_range_m < geometry.range.metres())) continue;
    const auto middle = std::min(static_cast<std::size_t>(displayed_range_m / spacing_m), power.size() - 1);
    const auto reach = static_cast<std::size_t>(std::ceil(0.5 * pulse_samples));
    const std::size_t end = std::min(middle + reach + 1, power.size());
    for (std::size_t i = middle - std::min(middle, reach); i < end; ++i) {
      const double fraction = covered(static_cast<double>(i), static_cast<double>(middle), pulse_samples);
      power[i] += static_cast<float>(fraction * reply.power);
    }
  }
}

}  // namespace yars::model::rbm
