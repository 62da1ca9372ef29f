#include "model/rbm/gas_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/reflectivity/decibels.hpp"

namespace yars::model::rbm {

namespace {
// Gauss and Legendre's eight places and weights on [-1, 1]. Source: Abramowitz and Stegun 1964, table 25.4.
constexpr std::array<double, 4> kPlaces{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
constexpr double kEarthRadius_m = 6371008.8;                 // mean; the bow of a ray is within 0.4 % for any azimuth
constexpr std::array<double, 3> kHeights_km{0.0, 2.0, 5.0};  // of the parabola in height
constexpr float kParabolaLowest_m = -500.0F, kParabolaHighest_m = 6000.0F;   // in which it holds

EffectiveEarth round_earth(const radar::Fidelity& fidelity) {
  const bool flat = fidelity.earth == radar::EarthModel::flat;
  return EffectiveEarth(flat ? std::numeric_limits<double>::infinity() : fidelity.earth_radius_factor * kEarthRadius_m);
}
}  // namespace

GasPath::GasPath(const radar::RadarConfiguration& configuration)
    : profile_(configuration.world.atmosphere, configuration.receiver.frequency_ghz) {}

double GasPath::one_way_db(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const {
  if (none()) return 0.0;
  const double bow_m = 0.5 * distance_m * distance_m * earth.curvature();
  const auto at = [&](double share) {
    return profile_.db_per_m(altitude_m + share * (height_m - altitude_m) - bow_m * share * (1.0 - share));
  };
  double mean = 0.0;
  for (std::size_t i = 0; i < kPlaces.size(); ++i)
    mean += 0.5 * kWeights[i] * (at(0.5 - 0.5 * kPlaces[i]) + at(0.5 + 0.5 * kPlaces[i]));
  return mean * std::hypot(distance_m, height_m - altitude_m - bow_m);
}

double GasPath::two_way_loss(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const {
  return none() ? 1.0 : reflectivity::ratio(-2.0 * one_way_db(earth, altitude_m, distance_m, height_m));
}

double GasPath::one_way_loss(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const {
  return none() ? 1.0 : reflectivity::ratio(-one_way_db(earth, altitude_m, distance_m, height_m));
}

GasSamples::GasSamples(const radar::RadarConfiguration& configuration, std::size_t samples)
    : earth_(round_earth(configuration.fidelity)), constant_(samples), slope_(samples), bend_(samples) {}

GasSamples::Parabola GasSamples::parabola_at(const GasPath& path, double altitude_m, double distance_m) const {
  const auto& h = kHeights_km;
  const auto loss = [&](double height_km) {
    return path.two_way_loss(earth_, altitude_m, distance_m, 1000.0 * height_km);
  };
  const double low = loss(h[0]), middle = loss(h[1]), high = loss(h[2]);
  const double bend = ((high - low) / h[2] - (middle - low) / h[1]) / (h[2] - h[1]);
  return {low, (middle - low) / h[1] - bend * h[1], bend};
}

void GasSamples::use(const GasPath& path, double altitude_m, double range_m, std::span<const float> distance_m,
                     bool same) {
  const bool known = altitude_m == altitude_m_ && range_m == range_m_;
  if (known && same) return;
  if (!known) {
    altitude_m_ = altitude_m;
    range_m_ = range_m;
    for (std::size_t knot = 0; knot < kKnots; ++knot)
      knots_[knot] = parabola_at(path, altitude_m, range_m * static_cast<double>(knot) / (kKnots - 1));
  }
  const double scale = static_cast<double>(kKnots - 1) / range_m;
  for (std::size_t i = 0; i < constant_.size(); ++i) {
    const double place = std::clamp(static_cast<double>(distance_m[i]) * scale, 0.0, static_cast<double>(kKnots - 1));
    const auto near = std::min(static_cast<std::size_t>(place), kKnots - 2);
    const double share = place - static_cast<double>(near);
    const Parabola& a = knots_[near];
    const Parabola& b = knots_[near + 1];
    constant_[i] = static_cast<float>(a.constant + share * (b.constant - a.constant));
    slope_[i] = static_cast<float>((a.slope + share * (b.slope - a.slope)) / 1000.0);
    bend_[i] = static_cast<float>((a.bend + share * (b.bend - a.bend)) / 1'000'000.0);
  }
}

void GasSamples::apply(const float* height_m, float* power) const {
  for (std::size_t i = 0; i < constant_.size(); ++i) {
    const float known_m = height_m[i] == height_m[i] ? height_m[i] : 0.0F;
    const float up_m = std::min(std::max(known_m, kParabolaLowest_m), kParabolaHighest_m);
    power[i] *= constant_[i] + up_m * (slope_[i] + up_m * bend_[i]);
  }
}

}  // namespace yars::model::rbm
