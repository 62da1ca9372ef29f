#include "model/rbm/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/physics/clutter.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kClear = -0.78;  // parameter of diffraction below which there is no loss

}  // namespace

Reference::Reference(const physics::RadarParameters& parameters)
    : fidelity_(parameters.fidelity),
      geometry_parameters_(parameters.geometry),
      receivers_(parameters),
      surface_(parameters),
      rain_(parameters),
      gas_(parameters),
      scene_covers_(parameters, sample_count(parameters)),
      samples_(sample_count(parameters)),
      bins_(kBinsOfCell * samples_.size()),
      slant_m_(bins_.size()),
      moved_bins_(bins_.size()),
      distance_m_(samples_.size()),
      steady_(samples_.size()) {
  weights_.reserve((2 * samples_.size() + 1) * kBinsOfCell);  // for any range scale
}

void Reference::use_weather(const physics::RadarParameters& parameters) {
  surface_.use_sea(parameters);
  rain_.use_showers(parameters);
}

std::size_t Reference::measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                               std::span<float> power) {
  const terrain::TerrainView& terrain = environment.terrain;
  const physics::EffectiveEarth earth = physics::effective_earth(geometry_parameters_, geometry);
  const physics::Receiver receiver = receivers_.at(geometry.range);
  physics::sample_distances(geometry.range, distance_m_);
  const std::size_t pending = read_terrain(geometry, terrain);
  const double spacing_m = geometry.range.metres() / static_cast<double>(samples_.size());
  surface_.use_texture({receiver.pulse_length_m, spacing_m, geometry.altitude.metres(), receiver.azimuth_cell_rad},
                       geometry.sim_time);
  walk_ground(geometry, receiver, physics::GroundWalk(geometry, earth, terrain, fidelity_.interpolation));
  if (fidelity_.slant_range) average_slant_ranges(geometry, earth);
  if (scene_covers_.enter(geometry, environment.scenes)) add_covers(geometry, *environment.scenes);
  rain_.enter(geometry);
  if (!rain_.dry()) add_rain(receiver, earth, geometry);
  if (fidelity_.slant_range) move_to_slant_range(geometry, earth);
  smear_pulse(fidelity_.pulse_smear ? receiver.pulse_length_m / spacing_m : 0.0, power);
  return pending;
}

std::size_t Reference::read_terrain(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) {
  const geo::GeodesicRay ray(geometry.apex, geometry.azimuth);
  std::size_t pending = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Sample& sample = samples_[i];
    sample = Sample{};
    sample.distance_m = distance_m_[i];
    const auto located = ray.position_and_azimuth(geo::Length::metres(sample.distance_m));
    const terrain::Surface surface = terrain.surface_at(located.point, fidelity_.interpolation);
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
  const double half_m = distance_m_.front();
  return {number, distance_m_[number] - half_m, distance_m_[number] + half_m, 1.0};
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
  std::fill(slant_m_.begin(), slant_m_.end(), 0.0);
  edge_ = kNoEdge;
  // The ground below the aircraft is seen straight downwards.
  Front front{0.0, walk.below().elevation_m, kNone, kNone};
  if (std::isnan(front.height_m)) front.tangent = front.height_m;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Sample& sample = samples_[i];
    Cell cell = cell_of(i);
    const double height_m = std::isnan(sample.height_m) ? 0.0 : sample.height_m;
    cell.gas = gas_.two_way_transmission(earth, altitude_m, sample.distance_m, height_m);
    const auto step = [&](const physics::GroundWalk::Point& point) {
      Front next{point.distance_m, point.surface.elevation_m, std::numeric_limits<double>::quiet_NaN(), front.horizon};
      if (!std::isnan(point.surface.peak_m)) {
        next.tangent = earth.tangent(altitude_m, point.distance_m, point.surface.peak_m);
        next.horizon = std::max(front.horizon, next.tangent);
        if (fidelity_.diffraction) follow_edge(front, next, receiver.wavelength_m);
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

// Parameter of diffraction of the ray to a point by the edge; NaN: no edge.
double Reference::parameter_at(double tangent, double distance_m, double wavelength_m) const {
  return physics::diffraction_parameter((edge_.tangent - tangent) * edge_.distance_m, edge_.distance_m, distance_m,
                                        wavelength_m);
}

// Ground that falls below the horizon makes the position before it an edge. It is left where it is clear of all rays.
void Reference::follow_edge(const Front& from, const Front& to, double wavelength_m) {
  if (to.tangent < from.horizon && from.tangent >= from.horizon && from.distance_m > 0.0) {
    edge_ = {from.horizon, from.distance_m};
  } else if (parameter_at(to.tangent, to.distance_m, wavelength_m) < kClear) {
    edge_ = kNoEdge;
  }
}

// Adds the return of the ground from one position of the walk to the next, as far as it is above the horizon, or as far
// as an edge bends rays to it. Land of
// the reflectivity gamma has the cross section gamma times its area normal to the ray: r theta_az times r times the
// angle of elevation over which it is seen. Sea has sigma0 times the area of its level surface. Texture and streets are
// those of the sample's middle, because texture belongs to a resolution cell.
void Reference::add_ground(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                           const physics::EffectiveEarth& earth, const Cell& cell, const Front& from, const Front& to,
                           const physics::GroundWalk::Point& point) {
  const bool diffracted = !std::isnan(edge_.tangent);
  const double hidden = diffracted ? from.tangent : from.horizon;
  if (std::isnan(from.tangent) || std::isnan(to.height_m) || !(to.tangent > hidden)) return;
  const double hidden_rad = std::atan(hidden), near_rad = std::atan(from.tangent), far_rad = std::atan(to.tangent);
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
  const double loss_db =
      diffracted ? physics::knife_edge_loss_db(parameter_at(sight.tangent, distance_m, receiver.wavelength_m)) : 0.0;
  const double way = cell.gas * physics::ratio(-2.0 * loss_db);
  const double power_per_m2 = physics::received(receiver, physics::returned_power(cells, way * gain, range_m), range_m);
  const double bin = kBins * (distance_m - cell.from_m) / (cell.to_m - cell.from_m);
  const auto number = static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0));
  const double power = kBins * power_per_m2 * (ground.gamma * normal_m2 + sea_m2);
  bins_[cell.number * kBinsOfCell + number] += power;
  slant_m_[cell.number * kBinsOfCell + number] += power * range_m;
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

// Turns the sums of slant range times power into means. A bin without return has the slant range of level ground.
void Reference::average_slant_ranges(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth) {
  const double cell_m = 2.0 * distance_m_.front();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double height_m = std::isnan(samples_[i].height_m) ? 0.0 : samples_[i].height_m;
    for (std::size_t bin = 0; bin < kBinsOfCell; ++bin) {
      const std::size_t at = i * kBinsOfCell + bin;
      const double distance_m = cell_m * (static_cast<double>(at) + 0.5) / kBins;
      slant_m_[at] = bins_[at] > 0.0 ? slant_m_[at] / bins_[at]
                                     : earth.slant_range_m(geometry.altitude.metres(), distance_m, height_m);
    }
  }
}

// Moves the bins from ground range to slant range. The pulse covers more ground the more its extent in slant range is
// below that over ground, so the power is multiplied by their ratio on level ground. The echo of a bin is shared by the
// two bins of slant range beside it.
void Reference::move_to_slant_range(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth) {
  const double altitude_m = geometry.altitude.metres();
  const double bin_m = 2.0 * distance_m_.front() / kBins;
  std::vector<double>& moved = moved_bins_;
  std::fill(moved.begin(), moved.end(), 0.0);
  for (std::size_t at = 0; at < bins_.size(); ++at) {
    if (bins_[at] == 0.0) continue;
    const Sample& sample = samples_[at / kBinsOfCell];
    const double height_m = std::isnan(sample.height_m) ? 0.0 : sample.height_m;
    const double from_m = bin_m * static_cast<double>(at);
    const double extent_m =
        earth.slant_range_m(altitude_m, from_m + bin_m, height_m) - earth.slant_range_m(altitude_m, from_m, height_m);
    const double echo = bins_[at] * extent_m / bin_m;
    const double to = std::max(0.0, slant_m_[at] / bin_m - 0.5);
    if (!(to < static_cast<double>(bins_.size()))) continue;
    const auto near = static_cast<std::size_t>(to);
    const double beyond = to - static_cast<double>(near);
    moved[near] += (1.0 - beyond) * echo;
    if (near + 1 < moved.size()) moved[near + 1] += beyond * echo;
  }
  bins_.swap(moved);
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
  const physics::SpeckleCells cells = physics::speckle_cells(spacing_m, receiver.pulse_length_m, state);
  const double gain_db = (gain - physics::kFullGain) * receiver.gain_step_db + window.automatic_gain_db;
  constexpr std::array<double, 3> kOneSweep{0.0, 1.0, 0.0};
  const std::array<double, 3>& weights = fidelity_.azimuth_smear ? physics::kAzimuthWeights : kOneSweep;
  std::fill(steady_.begin(), steady_.end(), 0.0);
  for (std::size_t sweep = 0; sweep < weights.size(); ++sweep)
    for (const physics::SteadyPower& part : window.steady[sweep])
      steady_[part.at] += weights[sweep] * static_cast<double>(part.power);
  for (std::size_t i = 0; i < video.size(); ++i) {
    const double power = weights[0] * static_cast<double>(window.before[i]) +
                         weights[1] * static_cast<double>(window.centre[i]) +
                         weights[2] * static_cast<double>(window.after[i]);
    // Clutter, thermal noise and jamming add as voltages of random phase. So their mean powers add, and one speckle
    // applies to the sum. Sensitivity time control acts on all of them, by the time of arrival.
    const double range_m = (static_cast<double>(i) + 0.5) * spacing_m;
    double total = power + physics::time_control(receiver, range_m) * (receiver.noise + window.jamming);
    if (fidelity_.noise) {
      const std::uint32_t bits = physics::noise_bits(state, physics::cell_of(static_cast<std::uint32_t>(i), cells));
      const float speckle = physics::speckle_levels(window.looks)[bits >> (32U - physics::kSpeckleBits)];
      total *= static_cast<double>(physics::with_steady(speckle, steady_[i] / total));
    }
    const double level = 1.0 + (10.0 * std::log10(total) + gain_db) / receiver.dynamic_range_db;
    video[i] = static_cast<std::uint8_t>(std::lround(std::clamp(255.0 * level, 0.0, 255.0)));
  }
}

}  // namespace yars::model::rbm
