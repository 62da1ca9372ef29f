#include "model/rbm/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/physics/clutter.hpp"

namespace yars::model::rbm {

namespace {
// Speckle of mean 1 and variance 1/looks: the mean of `looks` exponential variates of 16 random bits each.
double speckle(physics::NoiseState state, std::uint32_t cell, int looks) {
  double sum = 0.0;
  for (int i = 0; i < looks; ++i) {
    const std::uint32_t bits = physics::noise_bits(state, cell, static_cast<std::uint32_t>(i / 2));
    const std::uint32_t half = i % 2 == 0 ? bits >> 16U : bits & 0xffffU;
    sum -= std::log((half + 0.5) / 65536.0);
  }
  return sum / looks;
}
}  // namespace

Reference::Reference(const physics::RadarParameters& parameters)
    : fidelity_(parameters.fidelity),
      azimuth_beamwidth_deg_(parameters.azimuth_beamwidth_deg),
      receivers_(parameters),
      surface_(parameters),
      rain_(parameters),
      gas_(parameters),
      scene_covers_(parameters, sample_count(parameters)),
      samples_(sample_count(parameters)),
      distance_m_(samples_.size()) {}

void Reference::use_weather(const physics::RadarParameters& parameters) {
  surface_.use_sea(parameters);
  rain_.use_showers(parameters);
}

std::size_t Reference::measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                               std::span<float> power) {
  const terrain::TerrainView& terrain = environment.terrain;
  const physics::EffectiveEarth earth = physics::effective_earth(fidelity_, geometry.apex, geometry.azimuth);
  const physics::Receiver receiver = receivers_.at(geometry.range);
  physics::sample_distances(fidelity_, earth, geometry, terrain, distance_m_);
  const std::size_t pending = read_terrain(geometry, terrain);
  if (fidelity_.cross_track_slope) read_cross_slopes(geometry, terrain);
  const physics::GroundWalk walk(geometry, earth, terrain, fidelity_.interpolation);
  cast_shadows(geometry, earth, walk);
  const double spacing_m = geometry.range.metres() / static_cast<double>(samples_.size());
  const double pulse_samples = fidelity_.pulse_smear ? receiver.pulse_length_m / spacing_m : 1.0;
  surface_.use_resolution(receiver.pulse_length_m, spacing_m);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    samples_[i].power = samples_[i].lit ? cell_power(receiver, earth, geometry, i) : 0.0;
  }
  if (scene_covers_.enter(geometry, environment.scenes)) add_covers(geometry, receiver, earth, *environment.scenes);
  rain_.enter(geometry);
  if (!rain_.dry()) add_rain(receiver, earth, geometry);
  smear_pulse(pulse_samples, power);
  return pending;
}

std::size_t Reference::read_terrain(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  // Altitude hole: a sample at a slant range below the aircraft's height above ground has no ground point.
  constexpr terrain::Surface kHole{std::numeric_limits<double>::quiet_NaN(), 0.0, 0};
  const geo::GeodesicRay ray(geometry.apex, geometry.azimuth);
  std::size_t pending = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Sample& sample = samples_[i];
    sample = Sample{};
    sample.distance_m = distance_m_[i];
    const bool hole = std::isnan(sample.distance_m);
    const auto located = ray.position_and_azimuth(geo::Length::metres(hole ? 0.0 : sample.distance_m));
    const terrain::Surface surface = hole ? kHole : terrain.surface_at(located.point, fidelity_.interpolation);
    sample.position = located.point;
    sample.azimuth = located.azimuth;
    sample.height_m = surface.elevation_m;
    sample.peak_m = surface.peak_m;
    sample.water = surface.water;
    sample.material = surface.material;
    if (!surface.loaded) ++pending;
  }
  return pending;
}

void Reference::read_cross_slopes(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  const double side_rad = kSideRayBeamwidths * azimuth_beamwidth_deg_ * geo::kRadiansPerDegree;
  const geo::GeodesicRay left(geometry.apex, geometry.azimuth - geo::Angle::radians(side_rad));
  const geo::GeodesicRay right(geometry.apex, geometry.azimuth + geo::Angle::radians(side_rad));
  for (Sample& sample : samples_) {
    if (std::isnan(sample.distance_m)) continue;
    const geo::Length distance = geo::Length::metres(sample.distance_m);
    const auto height_m = [&](const geo::GeodesicRay& ray) {
      return terrain.surface_at(ray.position(distance), fidelity_.interpolation).elevation_m;
    };
    const double rise_m = height_m(right) - height_m(left);
    sample.cross_slope = std::isnan(rise_m) ? 0.0 : rise_m / (2.0 * side_rad * sample.distance_m);
  }
}

void Reference::cast_shadows(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth,
                             const physics::GroundWalk& walk) {
  // All ground raises the horizon, also between samples and outside the beam. A void neither raises the horizon nor
  // returns power. Where a cell is reduced to fewer posts, the highest original posts cast the shadow (peak_m). The
  // means of the original posts determine the power (height_m).
  double horizon = -std::numeric_limits<double>::infinity();
  double previous_m = 0.0;
  for (Sample& sample : samples_) {
    if (!std::isnan(sample.distance_m)) {
      horizon = std::max(horizon, walk.highest_tangent(previous_m, sample.distance_m));
      previous_m = sample.distance_m;
    }
    if (!std::isnan(sample.peak_m)) {
      const double tangent = earth.sight(geometry.altitude.metres(), sample.distance_m, sample.peak_m).tangent;
      sample.lit = tangent > horizon && !std::isnan(sample.height_m);
      horizon = std::max(horizon, tangent);
    }
    sample.horizon = horizon;
  }
}

double Reference::along_slope(std::size_t index) const {
  // Central difference; beside a void and at the ends of the sweep, the one-sided difference.
  const bool near_known = index > 0 && !std::isnan(samples_[index - 1].height_m);
  const bool far_known = index + 1 < samples_.size() && !std::isnan(samples_[index + 1].height_m);
  const Sample& near = samples_[near_known ? index - 1 : index];
  const Sample& far = samples_[far_known ? index + 1 : index];
  const double run_m = far.distance_m - near.distance_m;
  return run_m > 0.0 ? (far.height_m - near.height_m) / run_m : 0.0;
}

double Reference::cell_power(const physics::Receiver& receiver, const physics::EffectiveEarth& earth,
                             const physics::SweepGeometry& geometry, std::size_t index) const {
  const Sample& sample = samples_[index];
  const physics::Sight sight = earth.sight(geometry.altitude.metres(), sample.distance_m, sample.height_m);
  // Sine of the local grazing angle: the cosine of the angle between the ground's normal and the line to the radar.
  const double slope = along_slope(index);
  const double normal_length = std::sqrt(1.0 + slope * slope + sample.cross_slope * sample.cross_slope);
  const double sin_local = std::clamp((slope * sight.cos_grazing + sight.sin_grazing) / normal_length, 0.0, 1.0);
  const double cross_section_m2 =
      surface_.cross_section_m2(receiver, {sample.position, sample.azimuth, sight.slant_range_m, sin_local,
                                           sight.sin_grazing, sample.water, sample.material});
  const double gain = physics::two_way_gain(fidelity_.beam, receiver.elevation_beamwidth_rad,
                                            geometry.elevation.radians(), sight.elevation_rad);
  const double loss = gas_.two_way_transmission(earth, geometry.altitude.metres(), sample.distance_m, sample.height_m);
  return physics::received(receiver, physics::returned_power(cross_section_m2, loss * gain, sight.slant_range_m),
                           sight.slant_range_m);
}

void Reference::add_covers(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                           const physics::EffectiveEarth& earth, const scene::SceneView& scenes) {
  SceneCovers::Ground& ground = scene_covers_.ground();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    ground.distance_m[i] = samples_[i].distance_m;
    ground.height_m[i] = samples_[i].height_m;
    ground.cross_slope[i] = samples_[i].cross_slope;
    ground.power[i] = samples_[i].power;
  }
  scene_covers_.apply(geometry, receiver, earth, scenes);
  for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i].power = ground.power[i];
}

void Reference::add_rain(const physics::Receiver& receiver, const physics::EffectiveEarth& earth,
                         const physics::SweepGeometry& geometry) {
  const double altitude_m = geometry.altitude.metres();
  for (Sample& sample : samples_) {
    if (std::isnan(sample.distance_m)) continue;
    // Over a void the ray ends at sea level.
    const double height_m = std::isnan(sample.height_m) ? 0.0 : sample.height_m;
    const double slant_range_m = earth.sight(altitude_m, sample.distance_m, height_m).slant_range_m;
    const double rain = rain_.power(receiver, earth, geometry, sample.distance_m, std::atan(sample.horizon));
    const double loss = rain_.two_way_transmission(earth, altitude_m, sample.distance_m, height_m, slant_range_m);
    const double gas = gas_.two_way_transmission(earth, altitude_m, sample.distance_m, height_m);
    sample.transmission = loss;
    sample.power = (sample.power + gas * physics::received(receiver, rain, slant_range_m)) * loss;
  }
}

void Reference::smear_pulse(double pulse_samples, std::span<float> power) const {
  const physics::PulseSmear smear = physics::make_pulse_smear(pulse_samples);
  const auto count = static_cast<std::ptrdiff_t>(samples_.size());
  const std::ptrdiff_t reach = smear.reach;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (std::ptrdiff_t neighbour = std::max<std::ptrdiff_t>(i - reach, 0); neighbour <= std::min(i + reach, count - 1);
         ++neighbour) {
      sum += smear.weights[static_cast<std::size_t>(neighbour - i + reach)] *
             samples_[static_cast<std::size_t>(neighbour)].power;
    }
    power[static_cast<std::size_t>(i)] = static_cast<float>(sum);
  }
}

void Reference::lit(std::span<std::uint8_t> mask) const {
  std::transform(samples_.begin(), samples_.end(), mask.begin(),
                 [](const Sample& sample) { return sample.lit ? std::uint8_t{1} : std::uint8_t{0}; });
}

// No ground is taken to be straight, so the ground before each target is walked.
void Reference::describe(RayGround& ground) const {
  ground.transmission.resize(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    ground.distance_m[i] = samples_[i].distance_m;
    ground.samples[i].horizon = samples_[i].horizon;
    ground.samples[i].peak_m = samples_[i].peak_m;
    ground.transmission[i] = samples_[i].transmission;
  }
}

void Reference::form_video(const physics::PowerWindow& window, geo::Length range, int gain,
                           const physics::NoiseKey& key, std::span<std::uint8_t> video) {
  const physics::Receiver receiver = receivers_.at(range);
  const physics::NoiseState state = physics::make_noise_state(key);
  const double spacing_m = range.metres() / static_cast<double>(video.size());
  const float cells = physics::cells_per_sample(spacing_m, receiver.pulse_length_m);
  const double gain_db = (gain - physics::kFullGain) * receiver.gain_step_db;
  for (std::size_t i = 0; i < video.size(); ++i) {
    double power = static_cast<double>(window.centre[i]);
    if (fidelity_.azimuth_smear) {
      power = physics::kAzimuthWeights[0] * static_cast<double>(window.before[i]) +
              physics::kAzimuthWeights[1] * power + physics::kAzimuthWeights[2] * static_cast<double>(window.after[i]);
    }
    // Clutter, thermal noise and jamming add as voltages of random phase. So their mean powers add, and one speckle
    // applies to the sum.
    double total = power + receiver.noise + window.jamming;
    if (fidelity_.noise) {
      total *= speckle(state, physics::resolution_cell(static_cast<std::uint32_t>(i), cells), receiver.looks);
    }
    const double level = 1.0 + (10.0 * std::log10(total) + gain_db) / receiver.dynamic_range_db;
    video[i] = static_cast<std::uint8_t>(std::lround(std::clamp(255.0 * level, 0.0, 255.0)));
  }
}

}  // namespace yars::model::rbm
