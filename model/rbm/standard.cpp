#include "model/rbm/standard.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/rbm/noise.hpp"
#include "model/rbm/sample_places.hpp"

namespace yars::model::rbm {

namespace {
constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr double kSideShare = 0.25;  // of the beam width: where the side rays for the slope across lie
}  // namespace

Standard::Standard(const radar::RadarConfiguration& configuration)
    : configuration_(configuration),
      count_(sample_count(configuration)),
      distance_m_(count_),
      latitude_deg_(count_),
      longitude_deg_(count_),
      distance_(count_, 0.0F),
      elevation_(count_, kVoid),
      water_(count_, 0.0F),
      side_(count_, 0.0F),
      cross_slope_(count_, 0.0F),
      tangent_(count_, loops::kNoHorizon),
      spare_(count_, loops::kNoHorizon),
      horizon_(count_, loops::kNoHorizon),
      range_inverse_(count_, 0.0F),
      sin_grazing_(count_, 0.0F),
      cos_grazing_(count_, 0.0F),
      sin_sight_(count_, 0.0F),
      cos_sight_(count_, 0.0F),
      sin_local_(count_, 0.0F),
      gain_(count_, 0.0F),
      power_(count_, 0.0F) {}

std::size_t Standard::measure(const Look& look, const terrain::TerrainView& terrain, std::span<float> power) {
  const EffectiveEarth earth = effective_earth(configuration_.fidelity, look.apex, look.azimuth);
  const Receiver& receiver = receiver_at(look.range);
  sample_distances(configuration_.fidelity, earth, look, terrain, distance_m_);
  const std::size_t pending = read_terrain(look, terrain);
  if (configuration_.fidelity.cross_track_slope) read_cross_slopes(look, terrain);

  const loops::SweepConstants constants = sweep_constants(look, earth, receiver);
  const loops::SightArrays sights{tangent_.data(),     range_inverse_.data(), sin_grazing_.data(),
                                  cos_grazing_.data(), sin_sight_.data(),     cos_sight_.data()};
  loops::sight(count_, constants, distance_.data(), elevation_.data(), sights);
  loops::running_maximum(count_, tangent_.data(), spare_.data(), horizon_.data());
  loops::incidence(count_, distance_.data(), elevation_.data(), cross_slope_.data(), tangent_.data(), horizon_.data(),
                   sights, sin_local_.data());
  apply_beam(constants, sights);
  loops::power(count_, constants, water_.data(), sin_local_.data(), gain_.data(), sights, power_.data());

  const double spacing_m = look.range.metres() / static_cast<double>(count_);
  const double pulse_samples = configuration_.fidelity.pulse_smear ? receiver.pulse_length_m / spacing_m : 1.0;
  const PulseSmear smear = make_pulse_smear(pulse_samples);
  std::fill(power.begin(), power.end(), 0.0F);
  for (std::ptrdiff_t offset = -smear.reach; offset <= smear.reach; ++offset) {
    const auto weight = static_cast<float>(smear.weights[static_cast<std::size_t>(offset + smear.reach)]);
    loops::add_weighted(count_, power_.data() + offset, weight, power.data());
  }
  return pending;
}

const Receiver& Standard::receiver_at(geo::Length range) {
  if (receiver_.stc_range_m != range.metres()) receiver_ = make_receiver(configuration_, range);
  return receiver_;
}

std::size_t Standard::read_terrain(const Look& look, const terrain::TerrainView& terrain) {
  // What is nearer than the ground is looked up below the aircraft and made a void afterwards.
  std::size_t holes = 0;
  while (holes < count_ && std::isnan(distance_m_[holes])) distance_m_[holes++] = 0.0;
  sample_places(look.apex, look.azimuth, look.range, distance_m_, latitude_deg_, longitude_deg_);
  const std::size_t pending =
      terrain.elevations(latitude_deg_, longitude_deg_, {elevation_.data(), count_}, {water_.data(), count_});
  std::fill_n(elevation_.data(), holes, kVoid);
  for (std::size_t i = 0; i < count_; ++i) distance_.data()[i] = static_cast<float>(distance_m_[i]);
  return pending;
}

void Standard::read_cross_slopes(const Look& look, const terrain::TerrainView& terrain) {
  const double side_rad = kSideShare * configuration_.antenna.azimuth_beamwidth_deg * geo::kRadiansPerDegree;
  const auto read = [&](double turn_rad, Padded& out) {
    sample_places(look.apex, look.azimuth + geo::Angle::radians(turn_rad), look.range, distance_m_, latitude_deg_,
                  longitude_deg_);
    terrain.elevations(latitude_deg_, longitude_deg_, {out.data(), count_}, {spare_.data(), count_});
  };
  read(-side_rad, side_);
  read(side_rad, cross_slope_);
  for (std::size_t i = 0; i < count_; ++i) {
    const float rise_m = cross_slope_.data()[i] - side_.data()[i];
    const float run_m = static_cast<float>(2.0 * side_rad) * distance_.data()[i];
    cross_slope_.data()[i] = run_m > 0.0F && rise_m == rise_m ? rise_m / run_m : 0.0F;
  }
}

loops::SweepConstants Standard::sweep_constants(const Look& look, const EffectiveEarth& earth,
                                                const Receiver& receiver) const {
  const double elevation_rad = look.elevation.radians();
  const double beam_rad = receiver.elevation_beamwidth_rad;
  const double centre_rad = std::max(-elevation_rad, 0.5 * beam_rad);
  const double range_m = receiver.stc_range_m;
  loops::SweepConstants c;
  c.altitude_m = static_cast<float>(look.altitude.metres());
  c.curvature = static_cast<float>(earth.curvature());
  c.land_gamma = static_cast<float>(receiver.land_gamma);
  c.sea_less_land_gamma = static_cast<float>(receiver.sea_gamma - receiver.land_gamma);
  c.pulse_inverse = static_cast<float>(1.0 / receiver.pulse_length_m);
  c.beam_inverse = static_cast<float>(1.0 / beam_rad);
  c.scale = static_cast<float>(receiver.azimuth_beamwidth_rad / (receiver.full_scale * range_m * range_m * range_m));
  c.range_inverse = static_cast<float>(1.0 / range_m);
  c.range_power = static_cast<float>(receiver.stc_exponent - 3.0);
  c.sin_elevation = static_cast<float>(std::sin(elevation_rad));
  c.cos_elevation = static_cast<float>(std::cos(elevation_rad));
  c.sin_centre = static_cast<float>(std::sin(centre_rad));
  c.sin_centre_tilt = static_cast<float>(std::sin(centre_rad + elevation_rad));
  c.cos_centre_tilt = static_cast<float>(std::cos(centre_rad + elevation_rad));
  c.gaussian = static_cast<float>(kTwoWayExponent * std::numbers::log2e / (beam_rad * beam_rad));
  c.sin_half_beam = static_cast<float>(std::sin(0.5 * beam_rad));
  return c;
}

void Standard::apply_beam(const loops::SweepConstants& constants, const loops::SightArrays& sights) {
  switch (configuration_.fidelity.beam) {
    case radar::BeamPattern::hard_edge:
      return loops::gain_hard_edge(count_, constants, sights, gain_.data());
    case radar::BeamPattern::gaussian:
      return loops::gain_gaussian(count_, constants, sights, gain_.data());
    case radar::BeamPattern::cosecant_squared:
      return loops::gain_cosecant_squared(count_, constants, sights, gain_.data());
  }
}

void Standard::develop(const PowerWindow& window, geo::Length range, int gain, const NoiseKey& key,
                       std::span<std::uint8_t> video) {
  const Receiver& receiver = receiver_at(range);
  const radar::Fidelity& fidelity = configuration_.fidelity;
  std::array<float, 3> weights{0.0F, 1.0F, 0.0F};
  if (fidelity.azimuth_smear) {
    std::transform(kAzimuthWeights.begin(), kAzimuthWeights.end(), weights.begin(),
                   [](double weight) { return static_cast<float>(weight); });
  }
  const std::size_t count = video.size();
  loops::join_sweeps(count, window.before.data(), window.centre.data(), window.after.data(), weights.data(),
                     static_cast<float>(receiver.noise), power_.data());
  if (fidelity.noise) {
    const double spacing_m = range.metres() / static_cast<double>(count);
    loops::speckle(count, make_noise_state(key), cells_per_sample(spacing_m, receiver.pulse_length_m), receiver.looks,
                   spare_.data(), power_.data());
  }
  const double gain_db = (gain - kFullGain) * receiver.gain_step_db;
  loops::quantize(count, power_.data(), static_cast<float>(gain_db), static_cast<float>(receiver.decibels_per_scale),
                  video.data());
}

}  // namespace yars::model::rbm
