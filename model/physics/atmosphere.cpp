#include "model/physics/atmosphere.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/rain_attenuation.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::physics {

// Spectral lines: frequency [GHz] and six coefficients. Source: ITU-R P.676-13, Annex 1, Table 1 (oxygen, a1 to a6) and
// Table 2 (water vapour, b1 to b6).

using GasLine = std::array<double, 7>;

constexpr std::array<GasLine, 44> kOxygenLines{
    {{50.474214, 0.975, 9.651, 6.69, 0.0, 2.566, 6.85},     {50.987745, 2.529, 8.653, 7.17, 0.0, 2.246, 6.8},
     {51.50336, 6.193, 7.709, 7.64, 0.0, 1.947, 6.729},     {52.021429, 14.32, 6.819, 8.11, 0.0, 1.667, 6.64},
     {52.542418, 31.24, 5.983, 8.58, 0.0, 1.388, 6.526},    {53.066934, 64.29, 5.201, 9.06, 0.0, 1.349, 6.206},
     {53.595775, 124.6, 4.474, 9.55, 0.0, 2.227, 5.085},    {54.130025, 227.3, 3.8, 9.96, 0.0, 3.17, 3.75},
     {54.67118, 389.7, 3.182, 10.37, 0.0, 3.558, 2.654},    {55.221384, 627.1, 2.618, 10.89, 0.0, 2.56, 2.952},
     {55.783815, 945.3, 2.109, 11.34, 0.0, -1.172, 6.135},  {56.264774, 543.4, 0.014, 17.03, 0.0, 3.525, -0.978},
     {56.363399, 1331.8, 1.654, 11.89, 0.0, -2.378, 6.547}, {56.968211, 1746.6, 1.255, 12.23, 0.0, -3.545, 6.451},
     {57.612486, 2120.1, 0.91, 12.62, 0.0, -5.416, 6.056},  {58.323877, 2363.7, 0.621, 12.95, 0.0, -1.932, 0.436},
     {58.446588, 1442.1, 0.083, 14.91, 0.0, 6.768, -1.273}, {59.164204, 2379.9, 0.387, 13.53, 0.0, -6.561, 2.309},
     {59.590983, 2090.7, 0.207, 14.08, 0.0, 6.957, -0.776}, {60.306056, 2103.4, 0.207, 14.15, 0.0, -6.395, 0.699},
     {60.434778, 2438.0, 0.386, 13.39, 0.0, 6.342, -2.825}, {61.150562, 2479.5, 0.621, 12.92, 0.0, 1.014, -0.584},
     {61.800158, 2275.9, 0.91, 12.63, 0.0, 5.014, -6.619},  {62.41122, 1915.4, 1.255, 12.17, 0.0, 3.029, -6.759},
     {62.486253, 1503.0, 0.083, 15.13, 0.0, -4.499, 0.844}, {62.997984, 1490.2, 1.654, 11.74, 0.0, 1.856, -6.675},
     {63.568526, 1078.0, 2.108, 11.34, 0.0, 0.658, -6.139}, {64.127775, 728.7, 2.617, 10.88, 0.0, -3.036, -2.895},
     {64.67891, 461.3, 3.181, 10.38, 0.0, -3.968, -2.59},   {65.224078, 274.0, 3.8, 9.96, 0.0, -3.528, -3.68},
     {65.764779, 153.0, 4.473, 9.55, 0.0, -2.548, -5.002},  {66.302096, 80.4, 5.2, 9.06, 0.0, -1.66, -6.091},
     {66.836834, 39.8, 5.982, 8.58, 0.0, -1.68, -6.393},    {67.369601, 18.56, 6.818, 8.11, 0.0, -1.956, -6.475},
     {67.900868, 8.172, 7.708, 7.64, 0.0, -2.216, -6.545},  {68.431006, 3.397, 8.652, 7.17, 0.0, -2.492, -6.6},
     {68.960312, 1.334, 9.65, 6.69, 0.0, -2.773, -6.65},    {118.750334, 940.3, 0.01, 16.64, 0.0, -0.439, 0.079},
     {368.498246, 67.4, 0.048, 16.4, 0.0, 0.0, 0.0},        {424.76302, 637.7, 0.044, 16.4, 0.0, 0.0, 0.0},
     {487.249273, 237.4, 0.049, 16.0, 0.0, 0.0, 0.0},       {715.392902, 98.1, 0.145, 16.0, 0.0, 0.0, 0.0},
     {773.83949, 572.3, 0.141, 16.2, 0.0, 0.0, 0.0},        {834.145546, 183.1, 0.145, 14.7, 0.0, 0.0, 0.0}}};

constexpr std::array<GasLine, 35> kWaterLines{
    {{22.23508, 0.1079, 2.144, 26.38, 0.76, 5.087, 1.0},    {67.80396, 0.0011, 8.732, 28.58, 0.69, 4.93, 0.82},
     {119.99594, 0.0007, 8.353, 29.48, 0.7, 4.78, 0.79},    {183.310087, 2.273, 0.668, 29.06, 0.77, 5.022, 0.85},
     {321.22563, 0.047, 6.179, 24.04, 0.67, 4.398, 0.54},   {325.152888, 1.514, 1.541, 28.23, 0.64, 4.893, 0.74},
     {336.227764, 0.001, 9.825, 26.93, 0.69, 4.74, 0.61},   {380.197353, 11.67, 1.048, 28.11, 0.54, 5.063, 0.89},
     {390.134508, 0.0045, 7.347, 21.52, 0.63, 4.81, 0.55},  {437.346667, 0.0632, 5.048, 18.45, 0.6, 4.23, 0.48},
     {439.150807, 0.9098, 3.595, 20.07, 0.63, 4.483, 0.52}, {443.018343, 0.192, 5.048, 15.55, 0.6, 5.083, 0.5},
     {448.001085, 10.41, 1.405, 25.64, 0.66, 5.028, 0.67},  {470.888999, 0.3254, 3.597, 21.34, 0.66, 4.506, 0.65},
     {474.689092, 1.26, 2.379, 23.2, 0.65, 4.804, 0.64},    {488.490108, 0.2529, 2.852, 25.86, 0.69, 5.201, 0.72},
     {503.568532, 0.0372, 6.731, 16.12, 0.61, 3.98, 0.43},  {504.482692, 0.0124, 6.731, 16.12, 0.61, 4.01, 0.45},
     {547.67644, 0.9785, 0.158, 26.0, 0.7, 4.5, 1.0},       {552.02096, 0.184, 0.158, 26.0, 0.7, 4.5, 1.0},
     {556.935985, 497.0, 0.159, 30.86, 0.69, 4.552, 1.0},   {620.700807, 5.015, 2.391, 24.38, 0.71, 4.856, 0.68},
     {645.766085, 0.0067, 8.633, 18.0, 0.6, 4.0, 0.5},      {658.00528, 0.2732, 7.816, 32.1, 0.69, 4.14, 1.0},
     {752.033113, 243.4, 0.396, 30.86, 0.68, 4.352, 0.84},  {841.051732, 0.0134, 8.177, 15.9, 0.33, 5.76, 0.45},
     {859.965698, 0.1325, 8.055, 30.6, 0.68, 4.09, 0.84},   {899.303175, 0.0547, 7.914, 29.85, 0.68, 4.53, 0.9},
     {902.611085, 0.0386, 8.429, 28.65, 0.7, 5.1, 0.95},    {906.205957, 0.1836, 5.11, 24.08, 0.7, 4.7, 0.53},
     {916.171582, 8.4, 1.441, 26.73, 0.7, 5.15, 0.78},      {923.112692, 0.0079, 10.293, 29.0, 0.7, 5.0, 0.8},
     {970.315022, 9.009, 1.919, 25.5, 0.64, 4.94, 0.67},    {987.926764, 134.6, 0.257, 29.85, 0.68, 4.55, 0.9},
     {1780.0, 17506.0, 0.952, 196.3, 2.0, 24.15, 5.0}}};

namespace {
constexpr double kLowest_m = -1000.0, kHighest_m = 30'000.0, kStep_m = 100.0;  // heights [m MSL] of GasProfile
constexpr double kZeroCelsius_k = 273.15;

// The following three functions give contributions to N'', the imaginary part of the refractivity. Its unit is 1e-6 of
// the refractive index. `f`: frequency [GHz]; `theta`: 300 K / temperature; `vapour_hpa`: partial pressure of water
// vapour. Source: ITU-R P.676-13, Annex 1, equations (2) and following.

// Oxygen lines.
double oxygen(double f, const Air& air, double theta, double vapour_hpa) {
  const double theta3 = std::pow(theta, 3.0), theta08 = std::pow(theta, 0.8);
  double sum = 0.0;
  for (const GasLine& line : kOxygenLines) {
    const double line_ghz = line[0];
    const double strength = line[1] * 1e-7 * air.dry_hpa * theta3 * std::exp(line[2] * (1.0 - theta));
    const double dry_width = line[4] == 0.0 ? theta08 : std::pow(theta, 0.8 - line[4]);
    const double pressure_width = line[3] * 1e-4 * (air.dry_hpa * dry_width + 1.1 * vapour_hpa * theta);
    const double width = std::sqrt(pressure_width * pressure_width + 2.25e-6);
    const double mixing = (line[5] + line[6] * theta) * 1e-4 * (air.dry_hpa + vapour_hpa) * theta08;
    const double shape = (width - mixing * (line_ghz - f)) / ((line_ghz - f) * (line_ghz - f) + width * width) +
                         (width - mixing * (line_ghz + f)) / ((line_ghz + f) * (line_ghz + f) + width * width);
    sum += strength * f / line_ghz * shape;
  }
  return sum;
}

// Dry continuum: pressure-induced nitrogen attenuation and the Debye spectrum of oxygen.
double dry_continuum(double f, const Air& air, double theta, double vapour_hpa) {
  const double width = 5.6e-4 * (air.dry_hpa + vapour_hpa) * std::pow(theta, 0.8);
  const double debye = 6.14e-5 / (width * (1.0 + f / width * (f / width)));
  const double nitrogen = 1.4e-12 * air.dry_hpa * std::pow(theta, 1.5) / (1.0 + 1.9e-5 * std::pow(f, 1.5));
  return f * air.dry_hpa * theta * theta * (debye + nitrogen);
}

// Water vapour lines.
double vapour(double f, const Air& air, double theta, double vapour_hpa) {
  const double theta35 = std::pow(theta, 3.5);
  double sum = 0.0;
  for (const GasLine& line : kWaterLines) {
    const double line_ghz = line[0];
    const double strength = line[1] * 1e-1 * vapour_hpa * theta35 * std::exp(line[2] * (1.0 - theta));
    const double pressure_width =
        line[3] * 1e-4 * (air.dry_hpa * std::pow(theta, line[4]) + line[5] * vapour_hpa * std::pow(theta, line[6]));
    const double width = 0.535 * pressure_width +
                         std::sqrt(0.217 * pressure_width * pressure_width + 2.1316e-12 * line_ghz * line_ghz / theta);
    sum += strength * f / line_ghz *
           (width / ((line_ghz - f) * (line_ghz - f) + width * width) +
            width / ((line_ghz + f) * (line_ghz + f) + width * width));
  }
  return sum;
}
}  // namespace

double vapour_hpa(const Air& air) {
  return air.water_g_m3 * air.temperature_k / 216.7;
}

GasAttenuation gas_attenuation(double frequency_ghz, const Air& air) {
  const double theta = 300.0 / air.temperature_k;
  const double wet_hpa = vapour_hpa(air);
  const double scale = 0.1820 * frequency_ghz;
  return {scale * (oxygen(frequency_ghz, air, theta, wet_hpa) + dry_continuum(frequency_ghz, air, theta, wet_hpa)),
          scale * vapour(frequency_ghz, air, theta, wet_hpa)};
}

Air reference_air(const radar::AtmosphereConfiguration& atmosphere, double height_m) {
  constexpr double kLapse = 6.5, kUpperRise = 1.0;            // [K/km]
  constexpr double kTropopause_km = 11.0, kMiddle_km = 20.0;  // between these heights the temperature is constant
  constexpr double kExponent = 34.1632;                       // [K/km] hydrostatic constant g M / R of air
  constexpr double kWaterScale_km = 2.0;                      // rise in height over which water vapour falls to 1/e
  constexpr double kGeopotential_km = 6356.766;  // radius of the earth in the definition of geopotential heights
  const double above_km = height_m / 1000.0;
  const double height_km = kGeopotential_km * above_km / (kGeopotential_km + above_km);
  const double ground_k = atmosphere.temperature_c + kZeroCelsius_k;
  const double low_k = ground_k - kLapse * std::min(height_km, kTropopause_km);
  Air air{low_k, 0.0, atmosphere.water_g_m3 * std::exp(-above_km / kWaterScale_km)};
  double pressure_hpa = atmosphere.pressure_hpa * std::pow(low_k / ground_k, kExponent / kLapse);
  if (height_km > kTropopause_km)
    pressure_hpa *= std::exp(-kExponent * (std::min(height_km, kMiddle_km) - kTropopause_km) / low_k);
  if (height_km > kMiddle_km) {
    air.temperature_k = low_k + kUpperRise * (height_km - kMiddle_km);
    pressure_hpa *= std::pow(low_k / air.temperature_k, kExponent / kUpperRise);
  }
  air.dry_hpa = pressure_hpa - vapour_hpa(air);
  return air;
}

namespace {
// The tables of a thread's last profile. Objects of the same radar, such as its next scan, take them from here.
struct LastProfile {
  radar::AtmosphereConfiguration atmosphere;
  double frequency_ghz = 0.0;  // 0: none
  std::vector<double> db_per_m;

  bool is_of(const radar::AtmosphereConfiguration& other, double other_ghz) const {
    return frequency_ghz == other_ghz && atmosphere.temperature_c == other.temperature_c &&
           atmosphere.pressure_hpa == other.pressure_hpa && atmosphere.water_g_m3 == other.water_g_m3;
  }
};
}  // namespace

GasProfile::GasProfile(const radar::AtmosphereConfiguration& atmosphere, double frequency_ghz) {
  if (!atmosphere.gases) return;
  thread_local LastProfile last;
  if (!last.is_of(atmosphere, frequency_ghz)) {
    constexpr int kSteps = static_cast<int>((kHighest_m - kLowest_m) / kStep_m);
    last = {atmosphere, frequency_ghz, {}};
    for (int step = 0; step <= kSteps; ++step) {
      const double height_m = kLowest_m + step * kStep_m;
      const GasAttenuation found = gas_attenuation(frequency_ghz, reference_air(atmosphere, height_m));
      last.db_per_m.push_back((found.dry + found.water) / 1000.0);
    }
  }
  db_per_m_ = last.db_per_m;
}

double GasProfile::db_per_m(double height_m) const {
  if (empty()) return 0.0;
  const double index = std::clamp((height_m - kLowest_m) / kStep_m, 0.0, static_cast<double>(db_per_m_.size() - 1));
  const auto below = std::min(static_cast<std::size_t>(index), db_per_m_.size() - 2);
  const double fraction = index - static_cast<double>(below);
  return db_per_m_[below] + fraction * (db_per_m_[below + 1] - db_per_m_[below]);
}

namespace {
// Nodes and weights of Gauss-Legendre quadrature with eight nodes on [-1, 1]. Source: Abramowitz and Stegun 1964,
// table 25.4.
constexpr std::array<double, 4> kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
constexpr std::array<double, 3> kHeights_km{0.0, 2.0, 5.0};  // heights at which GasSamples' parabola equals the loss

// The same with a sphere of the mean earth radius, which is within 0.6 % of the ellipsoid's radius of curvature
// everywhere.
GeometryParameters on_sphere(GeometryParameters parameters) {
  if (parameters.earth == radar::EarthModel::ellipsoid) parameters.earth = radar::EarthModel::sphere;
  return parameters;
}
}  // namespace

GasPath::GasPath(const RadarParameters& parameters) : profile_(parameters.world.atmosphere, parameters.frequency_ghz) {}

double GasPath::one_way_db(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const {
  if (none()) return 0.0;
  const double drop_m = 0.5 * distance_m * distance_m * earth.curvature();
  const double sag_m = earth.sag_m(altitude_m, distance_m, height_m);
  const auto at = [&](double fraction) {
    return profile_.db_per_m(altitude_m + fraction * (height_m - altitude_m) - sag_m * fraction * (1.0 - fraction));
  };
  double mean = 0.0;
  for (std::size_t i = 0; i < kNodes.size(); ++i)
    mean += 0.5 * kWeights[i] * (at(0.5 - 0.5 * kNodes[i]) + at(0.5 + 0.5 * kNodes[i]));
  return mean * std::hypot(distance_m, height_m - altitude_m - drop_m);
}

double GasPath::two_way_transmission(const EffectiveEarth& earth, double altitude_m, double distance_m,
                                     double height_m) const {
  return none() ? 1.0 : ratio(-2.0 * one_way_db(earth, altitude_m, distance_m, height_m));
}

double GasPath::one_way_transmission(const EffectiveEarth& earth, double altitude_m, double distance_m,
                                     double height_m) const {
  return none() ? 1.0 : ratio(-one_way_db(earth, altitude_m, distance_m, height_m));
}

GasSamples::GasSamples(const RadarParameters& parameters, std::size_t samples)
    : parameters_(on_sphere(parameters.geometry)),
      earth_(std::numeric_limits<double>::infinity()),
      constant_(samples + 2 * terrain::kRunSlack),
      slope_(constant_),
      bend_(constant_) {}

GasSamples::Parabola GasSamples::parabola_at(const GasPath& path, double altitude_m, double distance_m) const {
  const auto& h = kHeights_km;
  const auto loss = [&](double height_km) {
    return path.two_way_transmission(earth_, altitude_m, distance_m, 1000.0 * height_km);
  };
  const double low = loss(h[0]), middle = loss(h[1]), high = loss(h[2]);
  const double bend = ((high - low) / h[2] - (middle - low) / h[1]) / (h[2] - h[1]);
  return {low, (middle - low) / h[1] - bend * h[1], bend};
}

void GasSamples::use(const GasPath& path, double altitude_m, double range_m, std::span<const float> distance_m) {
  if (altitude_m == altitude_m_ && range_m == range_m_) return;
  altitude_m_ = altitude_m;
  range_m_ = range_m;
  earth_ = effective_earth(parameters_, {}, geo::AltitudeMsl::metres(altitude_m), {});
  for (std::size_t knot = 0; knot < kKnots; ++knot)
    knots_[knot] = parabola_at(path, altitude_m, range_m * static_cast<double>(knot) / (kKnots - 1));
  const double scale = static_cast<double>(kKnots - 1) / range_m;
  for (std::size_t i = 0; i < distance_m.size(); ++i) {
    const double index = std::clamp(static_cast<double>(distance_m[i]) * scale, 0.0, static_cast<double>(kKnots - 1));
    const auto near = std::min(static_cast<std::size_t>(index), kKnots - 2);
    const double fraction = index - static_cast<double>(near);
    const Parabola& a = knots_[near];
    const Parabola& b = knots_[near + 1];
    constant_[i] = static_cast<float>(a.constant + fraction * (b.constant - a.constant));
    slope_[i] = static_cast<float>((a.slope + fraction * (b.slope - a.slope)) / 1000.0);
    bend_[i] = static_cast<float>((a.bend + fraction * (b.bend - a.bend)) / 1'000'000.0);
  }
}

void GasSamples::apply(const float* height_m, float* power) const {
  for (std::size_t i = 0; i + 2 * terrain::kRunSlack < constant_.size(); ++i) {
    const float known_m = height_m[i] == height_m[i] ? height_m[i] : 0.0F;
    const float up_m = std::min(std::max(known_m, kLowest_m), kHighest_m);
    power[i] *= constant_[i] + up_m * (slope_[i] + up_m * bend_[i]);
  }
}

namespace {
// Antiderivative of (depth - (x / radius)^2)^2.
double antiderivative(double depth, double radius_m, double x_m) {
  const double square = x_m * x_m / (radius_m * radius_m);
  return x_m * (depth * depth - square * (2.0 / 3.0 * depth - square / 5.0));
}
}  // namespace

double rain_reflectivity(const radar::RainConfiguration& rain, double rate_mmh, double wavelength_m) {
  constexpr double kCubicMetres = 1e-18;  // mm^6/m^3 in m^3
  const double z = rain.reflectivity_factor * std::pow(rate_mmh, rain.reflectivity_exponent) * kCubicMetres;
  return std::pow(std::numbers::pi, 5.0) * rain.dielectric_factor * z / std::pow(wavelength_m, 4.0);
}

double RainChord::profile(double distance_m) const {
  const double off_middle = (distance_m - middle_m) / radius_m;
  const double root = half_m > 0.0 ? std::max(0.0, depth - off_middle * off_middle) : 0.0;
  return root * root;
}

double RainChord::integral_m(double from_m, double to_m) const {
  const double from = std::max(from_m - middle_m, -half_m);
  const double to = std::min(to_m - middle_m, half_m);
  return to > from ? antiderivative(depth, radius_m, to) - antiderivative(depth, radius_m, from) : 0.0;
}

// Computed on a sphere of the mean earth radius. The distance from the shower's centre to the ray has an error of at
// most 0.3 %.
RainChord rain_chord(geo::GeoPoint apex, geo::Bearing azimuth, geo::GeoPoint middle, double radius_m) {
  const geo::GeodesicInverse path = geo::geodesic_inverse(apex, middle);
  const double arc_rad = path.distance.metres() / geo::kMeanEarthRadius_m;
  const double turn_rad = (path.azimuth_at_start - azimuth).radians();
  const double miss_m = geo::kMeanEarthRadius_m * std::asin(std::sin(arc_rad) * std::sin(turn_rad));
  RainChord chord;
  chord.radius_m = radius_m;
  chord.middle_m = geo::kMeanEarthRadius_m * std::atan2(std::sin(arc_rad) * std::cos(turn_rad), std::cos(arc_rad));
  chord.depth = 1.0 - miss_m * miss_m / (radius_m * radius_m);
  chord.half_m = chord.depth > 0.0 ? radius_m * std::sqrt(chord.depth) : 0.0;
  return chord;
}

std::vector<Shower> configured_showers(const RadarParameters& parameters) {
  const radar::RainConfiguration& rain = parameters.world.rain;
  const double wave_m = wavelength_m(parameters.frequency_ghz);
  const RainLaw law = configured_rain_law(parameters);
  std::vector<Shower> showers;
  for (const radar::RainCell& cell : rain.cells) {
    showers.push_back({cell.position, cell.radius_m, cell.top_m, rain_reflectivity(rain, cell.rate_mmh, wave_m),
                       rain_attenuation_db_per_m(law, cell.rate_mmh)});
  }
  return showers;
}

RainPath::RainPath(const RadarParameters& parameters) : beam_(parameters.beam) {
  use_showers(parameters);
}

void RainPath::use_showers(const RadarParameters& parameters) {
  showers_ = configured_showers(parameters);
  crossed_.clear();
  crossed_.reserve(showers_.size());
}

void RainPath::enter(const SweepGeometry& geometry) {
  crossed_.clear();
  for (const Shower& shower : showers_) {
    const RainChord chord = rain_chord(geometry.apex, geometry.azimuth, shower.position, shower.radius_m);
    const bool ahead = chord.middle_m + chord.half_m > 0.0 && chord.middle_m - chord.half_m < geometry.range.metres();
    if (chord.half_m > 0.0 && ahead) crossed_.push_back({chord, &shower});
  }
}

double RainPath::two_way_transmission(const EffectiveEarth& earth, double altitude_m, double distance_m,
                                      double height_m, double slant_range_m) const {
  const double slope = slant_range_m / distance_m;  // length of the ray per distance over ground
  double loss_db = 0.0;
  for (const Crossing& crossing : crossed_) {
    const Stretch wet = stretch_below(earth, altitude_m, distance_m, height_m, crossing.shower->top_m);
    loss_db += 2.0 * slope * crossing.shower->attenuation_db_per_m * crossing.chord.integral_m(wet.from_m, wet.to_m);
  }
  return ratio(-loss_db);
}

double RainPath::power(const Receiver& receiver, const EffectiveEarth& earth, const SweepGeometry& geometry,
                       double distance_m, double horizon_rad) const {
  double total = 0.0;
  for (const Crossing& crossing : crossed_) {
    const double profile = crossing.chord.profile(distance_m);
    if (!(profile > 0.0)) continue;
    const Sight top = earth.sight(geometry.altitude.metres(), distance_m, crossing.shower->top_m);
    const double lit_rad = beam_integral(beam_, receiver.elevation_beamwidth_rad, geometry.elevation.radians(),
                                         horizon_rad, top.elevation_rad);
    const double across_m2 = top.slant_range_m * receiver.azimuth_cell_rad * top.slant_range_m * lit_rad;
    total += returned_power(crossing.shower->reflectivity * profile * across_m2 * receiver.pulse_length_m, 1.0,
                            top.slant_range_m);
  }
  return total;
}

Stretch stretch_below(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                      double top_m) {
  // Height of the ray above the earth at the fraction s of the distance: drop_m s^2 + fall_m s + altitude_m.
  const double drop_m = earth.sag_m(altitude_m, distance_m, height_m);
  const double fall_m = height_m - altitude_m - drop_m;
  const double above_m = altitude_m - top_m;
  double from = 0.0;
  double to = 1.0;
  if (drop_m == 0.0) {
    if (fall_m == 0.0) return above_m < 0.0 ? Stretch{0.0, distance_m} : Stretch{};
    (fall_m < 0.0 ? from : to) = -above_m / fall_m;
  } else {
    const double square = fall_m * fall_m - 4.0 * drop_m * above_m;
    if (square <= 0.0) return {};
    const double q = -0.5 * (fall_m + std::copysign(std::sqrt(square), fall_m));
    from = std::min(q / drop_m, above_m / q);
    to = std::max(q / drop_m, above_m / q);
  }
  return {std::clamp(from, 0.0, 1.0) * distance_m, std::clamp(to, 0.0, 1.0) * distance_m};
}

}  // namespace yars::model::physics
