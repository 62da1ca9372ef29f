#include "model/rbm/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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
      receivers_(parameters),
      surface_(parameters),
      rain_(parameters),
      gas_(parameters),
      scene_covers_(parameters, sample_count(parameters)),
      samples_(sample_count(parameters)),
      bins_(kBinsOfCell * samples_.size()),
      distance_m_(samples_.size()) {
  weights_.reserve((2 * samples_.size() + 1) * kBinsOfCell);  // for any range scale
}

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
  const double spacing_m = geometry.range.metres() / static_cast<double>(samples_.size());
  surface_.use_texture({receiver.pulse_length_m, spacing_m, geometry.altitude.metres(), receiver.azimuth_cell_rad},
                       geometry.sim_time);
  walk_ground(geometry, receiver, physics::GroundWalk(geometry, earth, terrain, fidelity_.interpolation));
  if (scene_covers_.enter(geometry, environment.scenes)) add_covers(geometry, *environment.scenes);
  rain_.enter(geometry);
  if (!rain_.dry()) add_rain(receiver, earth, geometry);
  smear_pulse(fidelity_.pulse_smear ? receiver.pulse_length_m / spacing_m : 0.0, power);
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

// Ground between the middles of two samples belongs to the nearer middle.
Reference::Cell Reference::cell_of(std::size_t number) const {
  const auto known = [&](std::size_t at) { return at < samples_.size() && !std::isnan(distance_m_[at]); };
  const double middle_m = distance_m_[number];
  const double half_m = known(number + 1) ? 0.5 * (distance_m_[number + 1] - middle_m)
                                          : 0.5 * (middle_m - (number > 0 ? distance_m_[number - 1] : 0.0));
  const double from_m =
      number > 0 && known(number - 1) ? 0.5 * (distance_m_[number - 1] + middle_m) : std::max(0.0, middle_m - half_m);
  return {number, from_m, middle_m + half_m, 1.0};
}

// All ground raises the horizon, also between samples and outside the beam. A void neither raises the horizon nor
// returns power. Where a cell is reduced to fewer posts, the highest original posts cast the shadow (peak_m). The means
// of the original posts determine the slant range (height_m).
void Reference::walk_ground(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                            const physics::GroundWalk& walk) {
  constexpr double kStepsOfCell = 8.0;  // least number of steps of the walk in a cell
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const physics::EffectiveEarth& earth = walk.earth();
  const double altitude_m = geometry.altitude.metres();
  std::fill(bins_.begin(), bins_.end(), 0.0);
  // The ground below the aircraft is seen straight downwards.
  Front front{0.0, walk.below().elevation_m, kNone, kNone};
  if (std::isnan(front.height_m)) front.tangent = front.height_m;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Sample& sample = samples_[i];
    if (std::isnan(sample.distance_m)) {
      sample.horizon = kNone;
      continue;
    }
    Cell cell = cell_of(i);
    const double height_m = std::isnan(sample.height_m) ? 0.0 : sample.height_m;
    cell.gas = gas_.two_way_transmission(earth, altitude_m, sample.distance_m, height_m);
    const auto step = [&](const physics::GroundWalk::Point& point) {
      Front next{point.distance_m, point.surface.elevation_m, std::numeric_limits<double>::quiet_NaN(), front.horizon};
      if (!std::isnan(point.surface.peak_m)) {
        next.tangent = earth.tangent(altitude_m, point.distance_m, point.surface.peak_m);
        next.horizon = std::max(front.horizon, next.tangent);
        if (point.distance_m > cell.from_m) add_ground(geometry, receiver, earth, cell, front, next, point);
      }
      if (point.distance_m == sample.distance_m && !std::isnan(sample.peak_m))
        sample.lit = next.tangent > front.horizon && !std::isnan(sample.height_m);
      front = next;
    };
    const double step_m = (cell.to_m - cell.from_m) / kStepsOfCell;
    walk.visit(front.distance_m, cell.from_m, step_m, step);
    walk.visit(cell.from_m, sample.distance_m, step_m, step);
    sample.horizon = front.horizon;
    walk.visit(sample.distance_m, cell.to_m, step_m, step);
  }
  for (std::size_t i = 0; i < samples_.size(); ++i)
    for (std::size_t bin = 0; bin < kBinsOfCell; ++bin) samples_[i].power += bins_[i * kBinsOfCell + bin] / kBins;
}

// Adds the return of the ground from one position of the walk to the next, as far as it is above the horizon. Land of
// the reflectivity gamma has the cross section gamma times its area normal to the ray: r theta_az times r times the
// angle of elevation over which it is seen. Sea has sigma0 times the area of its level surface. Texture and streets are
// those of the sample's middle, because texture belongs to a resolution cell.
void Reference::add_ground(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                           const physics::EffectiveEarth& earth, const Cell& cell, const Front& from, const Front& to,
                           const physics::GroundWalk::Point& point) {
  if (std::isnan(from.tangent) || std::isnan(to.height_m) || !(to.tangent > from.horizon)) return;
  const double hidden_rad = std::atan(from.horizon), near_rad = std::atan(from.tangent),
               far_rad = std::atan(to.tangent);
  const double seen_rad = far_rad - hidden_rad;
  if (!(seen_rad > 0.0)) return;                             // less than the rounding of an angle
  const double seen_part = seen_rad / (far_rad - near_rad);  // of the way between the positions
  const double middle = 1.0 - 0.5 * seen_part;
  const double distance_m = from.distance_m + middle * (to.distance_m - from.distance_m);
  const double near_m = std::isnan(from.height_m) ? to.height_m : from.height_m;
  const physics::Sight sight =
      earth.sight(geometry.altitude.metres(), distance_m, near_m + middle * (to.height_m - near_m));
  const double range_m = sight.slant_range_m;
  const Sample& sample = samples_[cell.number];
  const physics::SurfaceReturn::Reflectivity ground = surface_.at(
      {sample.position, sample.azimuth, sight.sin_grazing, point.surface.water, point.surface.material, cell.number});
  const double normal_m2 = range_m * range_m * receiver.azimuth_cell_rad * seen_rad;
  const double sea_m2 =
      ground.sigma0 * range_m * receiver.azimuth_cell_rad * seen_part * (to.distance_m - from.distance_m);
  // The ground of this many cells returns at one time.
  const double cells = physics::illuminated_length_m(receiver, range_m, std::clamp(sight.sin_grazing, 0.0, 1.0)) /
                       (cell.to_m - cell.from_m);
  const double gain = physics::two_way_gain(fidelity_.beam, receiver.elevation_beamwidth_rad,
                                            geometry.elevation.radians(), sight.elevation_rad);
  const double power_per_m2 =
      physics::received(receiver, physics::returned_power(cells, cell.gas * gain, range_m), range_m);
  const double bin = kBins * (distance_m - cell.from_m) / (cell.to_m - cell.from_m);
  const auto number = static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0));
  bins_[cell.number * kBinsOfCell + number] += kBins * power_per_m2 * (ground.gamma * normal_m2 + sea_m2);
  samples_[cell.number].power_per_gamma += power_per_m2 * normal_m2;
}

// Scales the bins of each sample to its power with the covers.
void Reference::add_covers(const physics::SweepGeometry& geometry, const scene::SceneView& scenes) {
  SceneCovers::Ground& ground = scene_covers_.ground();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    ground.distance_m[i] = samples_[i].distance_m;
    ground.power[i] = samples_[i].power;
    ground.power_per_gamma[i] = samples_[i].power_per_gamma;
  }
  scene_covers_.apply(geometry, scenes);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (ground.power[i] == samples_[i].power) continue;
    for (std::size_t bin = 0; bin < kBinsOfCell; ++bin)
      bins_[i * kBinsOfCell + bin] *= ground.power[i] / samples_[i].power;
    samples_[i].power = ground.power[i];
  }
}

void Reference::add_rain(const physics::Receiver& receiver, const physics::EffectiveEarth& earth,
                         const physics::SweepGeometry& geometry) {
  const double altitude_m = geometry.altitude.metres();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Sample& sample = samples_[i];
    if (std::isnan(sample.distance_m)) continue;
    // Over a void the ray ends at sea level.
    const double height_m = std::isnan(sample.height_m) ? 0.0 : sample.height_m;
    const double slant_range_m = earth.sight(altitude_m, sample.distance_m, height_m).slant_range_m;
    const double rain = rain_.power(receiver, earth, geometry, sample.distance_m, std::atan(sample.horizon));
    const double loss = rain_.two_way_transmission(earth, altitude_m, sample.distance_m, height_m, slant_range_m);
    const double gas = gas_.two_way_transmission(earth, altitude_m, sample.distance_m, height_m);
    const double echo = gas * physics::received(receiver, rain, slant_range_m);
    sample.transmission = loss;
    sample.power = (sample.power + echo) * loss;
    for (std::size_t bin = 0; bin < kBinsOfCell; ++bin) {
      double& power = bins_[i * kBinsOfCell + bin];
      power = (power + echo) * loss;
    }
  }
}

void Reference::smear_pulse(double pulse_samples, std::span<float> power) {
  const auto count = static_cast<std::ptrdiff_t>(samples_.size());
  const auto reach = std::min(static_cast<std::ptrdiff_t>(std::ceil(0.5 * pulse_samples)), count);
  // Weights of the bins from `reach` samples before a sample to `reach` samples after it.
  weights_.resize(static_cast<std::size_t>(2 * reach + 1) * kBinsOfCell);
  const auto up_to = [&](std::size_t bin) {
    return physics::pulse_weight(pulse_samples, static_cast<double>(bin) / kBins - static_cast<double>(reach) - 0.5);
  };
  for (std::size_t bin = 0; bin < weights_.size(); ++bin) weights_[bin] = up_to(bin + 1) - up_to(bin);
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(i - reach, 0));
    const auto end = static_cast<std::size_t>(std::min(i + reach + 1, count));
    const auto skipped = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(first) - (i - reach));
    power[static_cast<std::size_t>(i)] = static_cast<float>(
        std::inner_product(bins_.begin() + static_cast<std::ptrdiff_t>(first * kBinsOfCell),
                           bins_.begin() + static_cast<std::ptrdiff_t>(end * kBinsOfCell),
                           weights_.begin() + static_cast<std::ptrdiff_t>(skipped * kBinsOfCell), 0.0));
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
  const double gain_db = (gain - physics::kFullGain) * receiver.gain_step_db + window.automatic_gain_db;
  for (std::size_t i = 0; i < video.size(); ++i) {
    double power = static_cast<double>(window.centre[i]);
    if (fidelity_.azimuth_smear) {
      power = physics::kAzimuthWeights[0] * static_cast<double>(window.before[i]) +
              physics::kAzimuthWeights[1] * power + physics::kAzimuthWeights[2] * static_cast<double>(window.after[i]);
    }
    // Clutter, thermal noise and jamming add as voltages of random phase. So their mean powers add, and one speckle
    // applies to the sum. Sensitivity time control acts on all of them, by the time of arrival.
    const double range_m = (static_cast<double>(i) + 0.5) * spacing_m;
    double total = power + physics::time_control(receiver, range_m) * (receiver.noise + window.jamming);
    if (fidelity_.noise) {
      total *= speckle(state, physics::resolution_cell(static_cast<std::uint32_t>(i), cells), receiver.looks);
    }
    const double level = 1.0 + (10.0 * std::log10(total) + gain_db) / receiver.dynamic_range_db;
    video[i] = static_cast<std::uint8_t>(std::lround(std::clamp(255.0 * level, 0.0, 255.0)));
  }
}

}  // namespace yars::model::rbm
