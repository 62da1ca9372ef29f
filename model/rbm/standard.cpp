#include "model/rbm/standard.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/physics/clutter.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/ray.hpp"

namespace yars::model::rbm {

namespace {
constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
// Ground between two samples is straight for point targets if it rises at most kMaxCrest_m above the next sample's line
// of sight, and the samples are at most max_straight_m() apart.
constexpr float kMaxCrest_m = 0.5F;

// [m] Coarser sweeps have coarser point targets. At 400 m, 2 % of the samples with movers differ from those over ground
// that is walked.
float max_straight_m(std::size_t samples) {
  constexpr float kMaxStraight_m = 200.0F, kSamples = 480.0F;
  return kMaxStraight_m * std::max(1.0F, kSamples / static_cast<float>(samples));
}
}  // namespace

Standard::Standard(const physics::RadarParameters& parameters)
    : fidelity_(parameters.fidelity),
      geometry_parameters_(parameters.geometry),
      receivers_(parameters),
      ground_(parameters, sample_count(parameters)),
      rain_(parameters, sample_count(parameters)),
      gas_(parameters),
      gas_samples_(parameters, sample_count(parameters)),
      scene_covers_(parameters, sample_count(parameters)),
      slant_axis_(sample_count(parameters)),
      count_(sample_count(parameters)),
      max_straight_m_(max_straight_m(count_)),
      distance_m_(count_),
      distance_(count_, 0.0F),
      one_step_inverse_(count_, 0.0F),
      midway_weight_(count_, 0.0F),
      cell_inverse_(count_, 0.0F),
      positions_(count_),
      ray_crests_(count_),
      elevation_(count_, kVoid),
      water_(count_, 0.0F),
      peak_(count_, kVoid),
      near_(count_, kVoid),
      near_back_(count_, 0.0F),
      crest_(count_, simd::kNoHorizon),
      tangent_(count_, simd::kNoHorizon),
      near_tangent_(count_, simd::kNoHorizon),
      before_(count_, simd::kNoHorizon),
      horizon_(count_, simd::kNoHorizon),
      power_(count_, 0.0F),
      power_per_gamma_(count_, 0.0F),
      variate_(count_, 1.0F),
      time_control_(count_, 1.0F),
      steady_(count_, 0.0F) {}

void Standard::use_weather(const physics::RadarParameters& parameters) {
  ground_.use_sea(parameters);
  rain_.use_showers(parameters);
}

std::size_t Standard::measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                              std::span<float> power) {
  const terrain::TerrainView& terrain = environment.terrain;
  const physics::EffectiveEarth earth = physics::effective_earth(geometry_parameters_, geometry);
  const physics::Receiver& receiver = receiver_at(geometry.range);
  update_distances(geometry.range);
  const std::size_t pending = read_terrain(geometry, terrain);

  const simd::SweepConstants constants = sweep_constants(geometry, earth, receiver);
  const double spacing_m = geometry.range.metres() / static_cast<double>(count_);
  const double pulse_samples = fidelity_.pulse_smear ? receiver.pulse_length_m / spacing_m : 0.0;
  ground_.use_texture({receiver.pulse_length_m, spacing_m, geometry.altitude.metres(), receiver.azimuth_cell_rad},
                      geometry.sim_time);
  const terrain::PositionRun positions = positions_.run();
  simd::SweepInputs inputs{distance_.data(), elevation_.data(),
                           // Where a cell is reduced to fewer posts, the highest original posts cast the shadow.
                           has_peaks_ ? peak_.data() : nullptr, near_.data(), near_back_.data(), nullptr,
                           midway_weight_.data(), cell_inverse_.data(), gas_loss(geometry),
                           ground_.prepare(geometry, positions, water_.data(), terrain.has_materials())};
  const bool covers = scene_covers_.enter(geometry, environment.scenes);
  const simd::SweepOutputs outputs{near_tangent_.data(), tangent_.data(), before_.data(),
                                   horizon_.data(),      power_.data(),   covers ? power_per_gamma_.data() : nullptr};
  simd::profile(count_, constants, inputs, outputs);
  has_crests_ =
      ray_crests_.find(terrain, {geometry.apex, geometry.azimuth, geometry.range, fidelity_.geodesic_knots}, positions_,
                       {geometry.altitude.metres(), earth.curvature(), earth.lift().of_elevation,
                        distance_.first(count_), horizon_.first(count_)},
                       crest_.first(count_));
  if (has_crests_) inputs.crest = crest_.data();
  simd::sweep(count_, constants, fidelity_.beam, inputs, outputs);
  // sweep() may have written after the last sample. The smear reads those entries, so they are set to 0.
  std::fill_n(power_.data() + count_, simd::kPad, 0.0F);
  if (covers) add_covers(geometry, *environment.scenes);
  rain_.enter(geometry);
  if (!rain_.dry()) add_rain(geometry, earth, receiver);
  if (fidelity_.slant_range) slant_axis_.move(geometry, earth, elevation_.first(count_), power_.first(count_));

  if (pulse_samples != smeared_samples_) {
    smeared_samples_ = pulse_samples;
    const physics::PulseSmear smear = physics::make_pulse_smear(pulse_samples);
    smear_reach_ = smear.reach;
    std::transform(smear.weights.begin(), smear.weights.end(), smear_weights_.begin(),
                   [](double weight) { return static_cast<float>(weight); });
  }
  simd::smear(count_, power_.data(), smear_weights_.data(), smear_reach_, power.data());
  return pending;
}

void Standard::lit(std::span<std::uint8_t> mask) const {
  const float* const tangent = tangent_.data();
  const float* const before = before_.data();
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = tangent[i] > before[i] ? 1 : 0;
}

physics::GasSamples::Coefficients Standard::gas_loss(const physics::SweepGeometry& geometry) {
  if (gas_.none()) return {};
  gas_samples_.use(gas_, geometry.altitude.metres(), geometry.range.metres(), distance_.first(count_));
  return gas_samples_.coefficients();
}

void Standard::add_covers(const physics::SweepGeometry& geometry, const scene::SceneView& scenes) {
  SceneCovers::Ground& ground = scene_covers_.ground();
  for (std::size_t i = 0; i < count_; ++i) {
    ground.distance_m[i] = distance_m_[i];
    ground.power[i] = static_cast<double>(power_.data()[i]);
    ground.power_per_gamma[i] = static_cast<double>(power_per_gamma_.data()[i]);
  }
  scene_covers_.apply(geometry, scenes);
  for (std::size_t i = 0; i < count_; ++i) power_.data()[i] = static_cast<float>(ground.power[i]);
}

// True if no ground between the previous sample and this one stands out. There point targets are shaded by a
// straight line between the peaks at both samples. `peak_m`: elevation of the ground that casts the shadow.
bool Standard::is_straight(std::size_t i, const float* peak_m) const {
  if (!has_crests_ || i == 0) return false;
  const float limit = std::max(horizon_.data()[i - 1], tangent_.data()[i] + kMaxCrest_m / distance_.data()[i]);
  const bool known = peak_m[i - 1] == peak_m[i - 1] && peak_m[i] == peak_m[i];
  return known && distance_.data()[i] - distance_.data()[i - 1] <= max_straight_m_ &&
         std::max(crest_.data()[i], near_tangent_.data()[i]) <= limit;
}

void Standard::describe(RayGround& ground) const {
  const float* const peak_m = has_peaks_ ? peak_.data() : elevation_.data();
  std::copy_n(distance_m_.begin(), count_, ground.distance_m.begin());
  for (std::size_t i = 0; i < count_; ++i) {
    const float slope = is_straight(i, peak_m) ? (peak_m[i] - peak_m[i - 1]) * one_step_inverse_.data()[i - 1] : kVoid;
    ground.samples[i] = {static_cast<double>(horizon_.data()[i]), static_cast<double>(peak_m[i]),
                         static_cast<double>(slope)};
  }
  ground.transmission.clear();
  if (!rain_.dry()) ground.transmission.assign(rain_.transmission(), rain_.transmission() + count_);
}

// Adds rain echo and applies rain attenuation.
void Standard::add_rain(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth,
                        const physics::Receiver& receiver) {
  rain_.measure(geometry, earth, receiver, {distance_.data(), elevation_.data(), horizon_.data()});
  if (!gas_.none()) gas_samples_.apply(elevation_.data(), rain_.power());
  const float* const rain = rain_.power();
  const float* const loss = rain_.transmission();
  for (std::size_t i = 0; i < count_; ++i) power_.data()[i] = (power_.data()[i] + rain[i]) * loss[i];
}

const physics::Receiver& Standard::receiver_at(geo::Length range) {
  if (receiver_.range_m != range.metres()) receiver_ = receivers_.at(range);
  return receiver_;
}

// Updates the ground distances of the samples and what depends on them alone.
void Standard::update_distances(geo::Length range) {
  if (spaced_range_m_ == range.metres()) return;
  spaced_range_m_ = range.metres();
  physics::sample_distances(range, distance_m_);
  for (std::size_t i = 0; i < count_; ++i) distance_.data()[i] = static_cast<float>(distance_m_[i]);
  const auto inverse = [](double step_m) { return step_m > 0.0 ? static_cast<float>(1.0 / step_m) : 0.0F; };
  for (std::size_t i = 0; i + 1 < count_; ++i) {
    one_step_inverse_.data()[i] = inverse(distance_m_[i + 1] - distance_m_[i]);
    midway_weight_.data()[i + 1] = static_cast<float>(distance_m_[i] / (distance_m_[i] + distance_m_[i + 1]));
  }
  // Over level ground at the height h below the aircraft the tangent rises by h (far - near) / (near far) from one edge
  // of a cell to the other. In the middle d it rises by h / d^2 per metre. The first cell and the last one have one
  // edge.
  for (std::size_t i = 0; i < count_; ++i) {
    const double middle_m = distance_m_[i];
    const bool has_near = i > 0, has_far = i + 1 < count_;
    const double near_m = has_near ? 0.5 * (distance_m_[i - 1] + middle_m) : middle_m;
    const double far_m = has_far ? 0.5 * (middle_m + distance_m_[i + 1]) : middle_m;
    const double halves = has_near == has_far ? 1.0 : 2.0;
    cell_inverse_.data()[i] =
        static_cast<float>(near_m * far_m / (middle_m * middle_m)) * inverse(halves * (far_m - near_m));
  }
}

std::size_t Standard::read_terrain(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  sampler_.sample(geometry.apex, geometry.azimuth, geometry.range, fidelity_.geodesic_knots, distance_.data(),
                  positions_);
  has_peaks_ = terrain.has_peaks();
  const auto step_m = static_cast<float>(geometry.range.metres() / static_cast<double>(count_));
  std::fill_n(near_.data(), count_, kVoid);
  const terrain::SurfaceRun found{elevation_.first(count_),
                                  water_.first(count_),
                                  peak_.first(has_peaks_ ? count_ : 0),
                                  {ground_.materials().data(), terrain.has_materials() ? count_ : 0},
                                  {step_m, near_.first(count_), near_back_.first(count_)}};
  const std::size_t pending = terrain.surfaces(positions_.run(), fidelity_.interpolation, found);
  for (Padded* heights : {&elevation_, &peak_, &near_})
    std::fill_n(heights->data() + count_, terrain::kRunSlack, kVoid);
  return pending;
}

simd::SweepConstants Standard::sweep_constants(const physics::SweepGeometry& geometry,
                                               const physics::EffectiveEarth& earth,
                                               const physics::Receiver& receiver) const {
  const double elevation_rad = geometry.elevation.radians();
  const double beam_rad = receiver.elevation_beamwidth_rad;
  const double centre_rad = std::max(-elevation_rad, 0.5 * beam_rad);
  const double range_m = physics::kFullScaleRange.metres();
  simd::SweepConstants c;
  c.altitude_m = static_cast<float>(geometry.altitude.metres());
  c.curvature = static_cast<float>(earth.curvature());
  const std::array<float, 1> farthest_m{distance_.data()[count_ - 1]};
  c.lift = physics::in_float(earth.lift(), {geometry.altitude.metres(), earth.curvature(), {}, farthest_m});
  c.land_gamma = static_cast<float>(receiver.land_gamma);
  c.pulse_inverse = static_cast<float>(1.0 / receiver.pulse_length_m);
  c.beam_inverse = static_cast<float>(1.0 / beam_rad);
  c.scale = static_cast<float>(receiver.azimuth_cell_rad / (receiver.full_scale * range_m * range_m * range_m));
  c.range_m = static_cast<float>(range_m);
  c.range_power = static_cast<float>(receiver.stc_exponent - 3.0);
  c.sin_elevation = static_cast<float>(std::sin(elevation_rad));
  c.cos_elevation = static_cast<float>(std::cos(elevation_rad));
  c.sin_centre = static_cast<float>(std::sin(centre_rad));
  c.sin_centre_tilt = static_cast<float>(std::sin(centre_rad + elevation_rad));
  c.cos_centre_tilt = static_cast<float>(std::cos(centre_rad + elevation_rad));
  c.gaussian = static_cast<float>(physics::kTwoWayExponent * std::numbers::log2e / (beam_rad * beam_rad));
  c.sin_half_beam = static_cast<float>(std::sin(0.5 * beam_rad));
  return c;
}

// Sensitivity time control of thermal noise and jamming, by sample.
const float* Standard::time_control(const physics::Receiver& receiver) {
  if (receiver.range_m == controlled_range_m_) return time_control_.data();
  controlled_range_m_ = receiver.range_m;
  const double spacing_m = receiver.range_m / static_cast<double>(count_);
  for (std::size_t i = 0; i < count_; ++i)
    time_control_.data()[i] =
        static_cast<float>(physics::time_control(receiver, (static_cast<double>(i) + 0.5) * spacing_m));
  return time_control_.data();
}

// Makes the speckle of samples with point targets weaker. Each sample is changed once, with the sum of its targets.
void Standard::hold_steady(const physics::PowerWindow& window, const physics::simd::VideoInputs& inputs) {
  const auto for_each = [&](const auto& use) {
    for (std::size_t sweep = 0; sweep < window.steady.size(); ++sweep)
      for (const physics::SteadyPower& part : window.steady[sweep]) use(part.at, inputs.weights[sweep] * part.power);
  };
  float* const steady = steady_.data();
  for_each([&](std::uint32_t at, float power) { steady[at] += power; });
  for_each([&](std::uint32_t at, float /*power*/) {
    if (!(steady[at] > 0.0F)) return;
    const float received = inputs.time_control == nullptr ? inputs.noise : inputs.noise * inputs.time_control[at];
    const float total = inputs.weights[0] * inputs.before[at] + inputs.weights[1] * inputs.centre[at] +
                        inputs.weights[2] * inputs.after[at] + received;
    variate_.data()[at] = physics::with_steady(variate_.data()[at], static_cast<double>(steady[at] / total));
    steady[at] = 0.0F;
  });
}

void Standard::form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                          std::span<std::uint8_t> video) {
  const physics::Receiver& receiver = receiver_at(range);
  const radar::Fidelity& fidelity = fidelity_;
  std::array<float, 3> weights{0.0F, 1.0F, 0.0F};
  if (fidelity.azimuth_smear) {
    std::transform(physics::kAzimuthWeights.begin(), physics::kAzimuthWeights.end(), weights.begin(),
                   [](double weight) { return static_cast<float>(weight); });
  }
  const std::size_t count = video.size();
  physics::simd::VideoInputs inputs{};
  inputs.before = window.before.data();
  inputs.centre = window.centre.data();
  inputs.after = window.after.data();
  inputs.weights = weights.data();
  inputs.noise = static_cast<float>(receiver.noise + window.jamming);
  if (receiver.stc_exponent != 0.0) inputs.time_control = time_control(receiver);
  inputs.gain_db = static_cast<float>((gain - physics::kFullGain) * receiver.gain_step_db + window.automatic_gain_db);
  inputs.dynamic_range_db = static_cast<float>(receiver.dynamic_range_db);
  if (fidelity.noise) {
    const physics::NoiseState state = physics::make_noise_state(key);
    physics::simd::speckle(
        count, state, window.looks,
        physics::speckle_cells(range.metres() / static_cast<double>(count), receiver.pulse_length_m, state),
        variate_.data());
    inputs.variate = variate_.data();
    hold_steady(window, inputs);
  }
  physics::simd::form_video(count, inputs, video.data());
}

}  // namespace yars::model::rbm
