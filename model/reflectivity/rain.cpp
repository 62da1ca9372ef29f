#include "model/reflectivity/rain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace yars::model::reflectivity {

namespace {
constexpr double kMeanEarthRadiusM = 6371008.8;  // [m] how a great circle passes a place: to 0.3 % of the distance

// Antiderivative of (depth - (x / radius)^2)^2.
double primitive(double depth, double radius_m, double x_m) {
  const double square = x_m * x_m / (radius_m * radius_m);
  return x_m * (depth * depth - square * (2.0 / 3.0 * depth - square / 5.0));
}
}  // namespace

double rain_reflectivity(const radar::RainConfiguration& rain, double rate_mmh, double wavelength_m) {
  constexpr double kCubicMetres = 1e-18;  // of a drop's sixth power, mm^6 in m^6
  const double z = rain.reflectivity_factor * std::pow(rate_mmh, rain.reflectivity_exponent) * kCubicMetres;
  return std::pow(std::numbers::pi, 5.0) * rain.dielectric_factor * z / std::pow(wavelength_m, 4.0);
}

double rain_attenuation_db_per_m(const radar::RainConfiguration& rain, double rate_mmh) {
  return rain.attenuation_factor * std::pow(rate_mmh, rain.attenuation_exponent) / 1000.0;
}

double RainChord::profile(double distance_m) const {
  const double share = (distance_m - middle_m) / radius_m;
  const double root = half_m > 0.0 ? std::max(0.0, depth - share * share) : 0.0;
  return root * root;
}

double RainChord::integral_m(double from_m, double to_m) const {
  const double from = std::max(from_m - middle_m, -half_m);
  const double to = std::min(to_m - middle_m, half_m);
  return to > from ? primitive(depth, radius_m, to) - primitive(depth, radius_m, from) : 0.0;
}

RainChord rain_chord(geo::GeoPoint apex, geo::Bearing azimuth, geo::GeoPoint middle, double radius_m) {
  const geo::GeodesicInverse way = geo::geodesic_inverse(apex, middle);
  const double arc = way.distance.metres() / kMeanEarthRadiusM;
  const double turn = (way.azimuth_at_start - azimuth).radians();
  const double miss_m = kMeanEarthRadiusM * std::asin(std::sin(arc) * std::sin(turn));
  RainChord chord;
  chord.radius_m = radius_m;
  chord.middle_m = kMeanEarthRadiusM * std::atan2(std::sin(arc) * std::cos(turn), std::cos(arc));
  chord.depth = 1.0 - miss_m * miss_m / (radius_m * radius_m);
  chord.half_m = chord.depth > 0.0 ? radius_m * std::sqrt(chord.depth) : 0.0;
  return chord;
}

}  // namespace yars::model::reflectivity
