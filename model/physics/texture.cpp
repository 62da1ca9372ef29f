#include "model/physics/texture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/computed_once.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/ray.hpp"

namespace yars::model::physics {

double TextureSteps::steps(double shape) {
  return kPerOctave * std::log2(shape / kMinShape);
}

std::int32_t TextureSteps::entry(double shape) {
  const double step = std::round(steps(shape));
  const int known = shape > 0.0 && step < kShapes ? std::max(0, static_cast<int>(step)) : kNone;
  return known * static_cast<std::int32_t>(kTextureLevels);
}

namespace {
using AllLevels = std::array<float, TextureSteps::kEntries>;

std::unique_ptr<const AllLevels> computed_levels() {
  auto made = std::make_unique<AllLevels>();
  made->fill(1.0F);
  for (int step = 0; step < TextureSteps::kShapes; ++step) {
    const double shape = TextureSteps::kMinShape * std::exp2(static_cast<double>(step) / TextureSteps::kPerOctave);
    const TextureLevels levels = make_texture_levels(shape);
    std::copy(levels.begin(), levels.end(), made->begin() + step * static_cast<std::ptrdiff_t>(kTextureLevels));
  }
  return made;
}
}  // namespace

const std::array<float, TextureSteps::kEntries>& TextureSteps::levels() {
  static memory::ComputedOnce<AllLevels> all;
  return all.get(computed_levels);
}

LandKind land_kind(std::size_t material) {
  constexpr std::uint32_t kEven = 1U << 7U | 1U << 9U | 1U << 11U | 1U << 12U | 1U << 13U;
  return (kEven >> material & 1U) != 0 ? LandKind::even : LandKind::rural;
}

namespace {
struct Slope {
  double grazing_deg, slope;
};
// Rural land in cells of 1,000 m^2, in the middle of the classes of the angle.
// Source: Billingsley's interim clutter model as quoted by an open program (docs/spec/physics.md#texture).
constexpr std::array<Slope, 5> kRural{{{0.125, 3.8}, {0.5, 3.5}, {1.125, 3.0}, {2.75, 2.7}, {4.0, 2.6}}};
constexpr double kCell_m2 = 1000.0;
// Slope less 1 of forest, desert, marsh and grassland (2.0) over that of rural land at the same angles.
constexpr double kEvenShare = 0.55;
// The slope less 1 falls with this power of the area, and with that of the angle above the table's last one (chosen).
constexpr double kAreaPower = 1.0 / 6.0, kAnglePower = 0.5;

double rural_slope(double grazing_deg) {
  if (grazing_deg <= kRural.front().grazing_deg) return kRural.front().slope;
  for (std::size_t i = 1; i < kRural.size(); ++i) {
    const Slope &low = kRural[i - 1], &high = kRural[i];
    if (grazing_deg < high.grazing_deg)
      return std::lerp(low.slope, high.slope, (grazing_deg - low.grazing_deg) / (high.grazing_deg - low.grazing_deg));
  }
  return 1.0 + (kRural.back().slope - 1.0) * std::pow(kRural.back().grazing_deg / grazing_deg, kAnglePower);
}
}  // namespace

double weibull_slope(LandKind kind, double grazing_deg, double cell_m2) {
  const double share = kind == LandKind::even ? kEvenShare : 1.0;
  const double area = std::pow(std::max(cell_m2 / kCell_m2, 1.0), -kAreaPower);
  return 1.0 + (rural_slope(grazing_deg) - 1.0) * share * area;
}

double sea_shape(radar::Polarization polarization, double grazing_deg, double cell_m2) {
  constexpr double kMin_deg = 0.1, kMax_deg = 10.0;  // limits of the measurements
  const double k = polarization == radar::Polarization::vertical ? 1.39 : 2.09;
  const double angle_deg = std::clamp(grazing_deg, kMin_deg, kMax_deg);
  return std::pow(10.0, 2.0 / 3.0 * std::log10(angle_deg) + 5.0 / 8.0 * std::log10(cell_m2) - k);
}

double sea_turn(double cosine) {
  return std::pow(10.0, (1.0 - 2.0 * cosine * cosine) / 3.0);
}

double inverse_shape_of_slope(double slope) {
  const double mean = std::tgamma(1.0 + slope);
  return 0.5 * std::tgamma(1.0 + 2.0 * slope) / (mean * mean) - 1.0;
}

namespace {
double cells_in_sample(int sub_beams, bool pulse_smear, double width) {
  // A sample of one ray has parts of several cells in the pulse. Rays closer than a cell have cells in common.
  const double in_pulse = pulse_smear ? 1.9 : 1.0;
  return in_pulse * std::min(1.0 + 0.8 * width, std::max(1.0, 0.6 * sub_beams));
}
}  // namespace

double cells_in_sample(const RadarParameters& parameters, double width) {
  return cells_in_sample(parameters.fidelity.sub_beams, parameters.fidelity.pulse_smear, width);
}

namespace {
// Effective earth radius factor for classes of grazing angles, which need no exact refraction.
double radius_factor(double configured) {
  constexpr double kMean = 4.0 / 3.0, kLeast = 0.1;
  return std::isnan(configured) ? kMean : std::max(kLeast, configured);
}
}  // namespace

SampleTextures::SampleTextures(const RadarParameters& parameters)
    : pulse_smear_(parameters.fidelity.pulse_smear),
      polarization_(parameters.world.sea.polarization),
      sub_beams_(parameters.fidelity.sub_beams),
      effective_radius_m_(parameters.geometry.earth == radar::EarthModel::flat
                              ? std::numeric_limits<double>::infinity()
                              : geo::kMeanEarthRadius_m * radius_factor(parameters.geometry.earth_radius_factor)),
      samples_(parameters.samples) {
  resize(samples_);
}

void SampleTextures::resize(std::size_t samples) {
  samples_ = samples;
  sweep_ = {};
  for (auto& entries : land_) entries.assign(samples + kPairSlack, TextureSteps::entry(0.0));
  sea_.assign(samples + kPairSlack, static_cast<float>(TextureSteps::kNone));
}

void SampleTextures::use(const TextureSweep& sweep) {
  constexpr double kMinAltitude_m = 10.0, kClassesPerOctave = 8.0;
  TextureSweep now = sweep;
  const double octaves = std::log2(std::max(sweep.altitude_m, kMinAltitude_m));
  now.altitude_m = std::exp2(std::round(octaves * kClassesPerOctave) / kClassesPerOctave);
  if (now == sweep_) return;
  const double cell_m = texture_cell_m(now.pulse_length_m, now.spacing_m);
  if (cell_m != cell_m_) grid_ = make_ground_grid(cell_m);
  cell_m_ = cell_m;
  sweep_ = now;
  update();
}

// Source of the grazing angle: docs/spec/physics.md#incidence.
SampleTextures::Place SampleTextures::place(std::size_t sample) const {
  const double along_m = (static_cast<double>(sample) + 0.5) * sweep_.spacing_m;
  const double height_m = sweep_.altitude_m;
  const double range_m = std::hypot(along_m, height_m);
  const double sine =
      height_m / range_m - (range_m * range_m - height_m * height_m) / (2.0 * range_m * effective_radius_m_);
  return {std::asin(std::clamp(sine, 0.0, 1.0)) / geo::kRadiansPerDegree, range_m};
}

void SampleTextures::update() {
  if (!sweep_.has_beam()) {
    for (auto& entries : land_) entries.assign(entries.size(), TextureSteps::entry(0.0));
    return;
  }
  for (std::size_t i = 0; i < samples_; ++i) {
    const Place at = place(i);
    const double width_m = at.range_m * sweep_.azimuth_cell_rad;
    const double cosine = std::max(std::cos(at.grazing_deg * geo::kRadiansPerDegree), 0.1);
    const double area_m2 = width_m * sweep_.pulse_length_m / cosine;
    const double cells = cells_in_sample(sub_beams_, pulse_smear_, width_m / cell_m_);
    sea_[i] = static_cast<float>(TextureSteps::steps(sea_shape(polarization_, at.grazing_deg, area_m2) / cells));
    for (const LandKind kind : {LandKind::rural, LandKind::even})
      land_[static_cast<std::size_t>(kind)][i] =
          TextureSteps::entry(1.0 / (cells * inverse_shape_of_slope(weibull_slope(kind, at.grazing_deg, area_m2))));
  }
}

}  // namespace yars::model::physics
