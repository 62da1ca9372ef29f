#include "model/physics/reflectivity.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/radar/world.hpp"
#include "lib/random/counter_rng.hpp"

namespace yars::model::physics {

namespace {

constexpr double kPatch_m = 5000.0;  // spacing of street patches, the size of a medium town
constexpr double kRow_deg = kPatch_m / geo::kMetresPerDegree;
constexpr std::uint32_t kSeed = 0;  // not the landscape's seed, because real culture uses the same streets

}  // namespace

void StreetFinder::use_row(std::int32_t middle_row) {
  if (middle_row == middle_row_) return;
  middle_row_ = middle_row;
  for (int i = 0; i < 3; ++i) {
    Row& row = rows_[static_cast<std::size_t>(i)];
    const double row_middle_deg = std::clamp((middle_row - 1 + i + 0.5) * kRow_deg - 90.0, -90.0, 90.0);
    row.columns = std::max(1, static_cast<int>(360.0 * std::cos(row_middle_deg * geo::kRadiansPerDegree) / kRow_deg));
    row.column_deg = 360.0 / row.columns;
    row.middle = kNoRow;
  }
}

void StreetFinder::use_column(Row& row, std::int32_t number, int middle) {
  if (middle == row.middle) return;
  row.middle = middle;
  for (int i = 0; i < 3; ++i) {
    const int column = middle - 1 + i;
    StreetPatch& patch = row.neighbours[static_cast<std::size_t>(i)];
    // The third argument makes the two hashes independent: 3 for the origin, 4 for the bearing.
    const std::uint32_t hash = random::lattice_hash((column + row.columns) % row.columns, number, 3, kSeed);
    patch.origin = {(number + static_cast<double>(hash & 0xFFFFU) / 65536.0) * kRow_deg - 90.0,
                    (column + static_cast<double>(hash >> 16U) / 65536.0) * row.column_deg - 180.0};
    // Half of the patches have streets within 7.5 degrees of north-south and east-west, as surveyed towns do.
    const std::uint32_t draw = random::lattice_hash((column + row.columns) % row.columns, number, 4, kSeed);
    patch.bearing_deg = (draw & 1U) != 0 ? 90.0 * random::unit_fraction(draw)
                                         : std::fmod(97.5 - 15.0 * random::unit_fraction(draw), 90.0);
  }
}

const StreetPatch& StreetFinder::nearest(geo::GeoPoint position) {
  const double latitude_deg = std::clamp(position.latitude_deg, -90.0, 90.0);
  const double longitude_deg = geo::wrapped_degrees(position.longitude_deg);
  const double parallel = std::cos(latitude_deg * geo::kRadiansPerDegree);
  use_row(static_cast<std::int32_t>(std::floor((latitude_deg + 90.0) / kRow_deg)));
  const StreetPatch* nearest = &rows_[0].neighbours[0];
  double min_square = 1e9;
  for (std::int32_t i = 0; i < 3; ++i) {
    Row& row = rows_[static_cast<std::size_t>(i)];
    use_column(row, middle_row_ - 1 + i, static_cast<int>((longitude_deg + 180.0) / row.column_deg));
    for (const StreetPatch& patch : row.neighbours) {
      const double east = (longitude_deg - patch.origin.longitude_deg) * parallel;
      const double north = latitude_deg - patch.origin.latitude_deg;
      const double square = east * east + north * north;
      if (square >= min_square) continue;
      min_square = square;
      nearest = &patch;
    }
  }
  return *nearest;
}

StreetPatch StreetFinder::patch(geo::GeoPoint position) {
  StreetPatch found = nearest(position);
  found.origin.longitude_deg = geo::wrapped_degrees(found.origin.longitude_deg);
  return found;
}

StreetPatch street_patch(geo::GeoPoint position) {
  return StreetFinder().patch(position);
}

double frequency_term_db(const radar::LandConfiguration& land, double frequency_ghz) {
  return land.frequency_slope_db * std::log10(frequency_ghz / land.reference_frequency_ghz);
}

LandReturn make_land_return(const RadarParameters& parameters) {
  const radar::LandConfiguration& land = parameters.world.land;
  const double frequency_db = frequency_term_db(land, parameters.frequency_ghz);
  LandReturn result;
  result.cardinal_width_deg = land.cardinal_width_deg;
  result.gamma.fill(ratio(parameters.receiver.land_gamma_db + frequency_db));
  for (const radar::Material& material : land.materials) {
    const auto code = static_cast<std::size_t>(material.code);
    if (code >= result.gamma.size()) continue;
    result.gamma[code] = ratio(material.gamma_db + frequency_db);
    result.cardinal[code] = ratio(material.cardinal_db) - 1.0;
  }
  return result;
}

double off_street_deg(double azimuth_deg, double street_deg) {
  constexpr double kQuarterTurn = 90.0;  // walls stand along and across the streets
  const double turn = azimuth_deg - street_deg;
  return turn - kQuarterTurn * std::floor(turn / kQuarterTurn + 0.5);
}

double cardinal_gain(double cardinal, double off_deg, double width_deg) {
  const double widths = off_deg / width_deg;
  return 1.0 + cardinal * std::exp(-4.0 * std::numbers::ln2 * widths * widths);
}

namespace {
// [cardinal_width_deg] Angle beyond which the cardinal effect is set to 0. At this angle 2^-64 of the effect remains.
constexpr double kCutoffWidths = 4.0;
constexpr double kMaxOff_deg = 89.0;  // upper limit of the cutoff angle, because its tangent must be finite
// Intervals of the table of the cardinal effect. An interval is 1/64 of the effect's width. Linear interpolation then
// errs by 1e-4.
constexpr int kSteps = 256;
}  // namespace

SceneSurface::SceneSurface(const RadarParameters& parameters)
    : street_width_deg_(parameters.world.land.cardinal_width_deg),
      cutoff_deg_(std::min(kCutoffWidths * street_width_deg_, kMaxOff_deg)),
      cutoff_tangent_(std::tan(cutoff_deg_ * geo::kRadiansPerDegree)) {
  const LandReturn land = make_land_return(parameters);
  for (std::size_t code = 0; code < land.gamma.size(); ++code) {
    const std::size_t source = code == 0 ? static_cast<std::size_t>(parameters.high_resolution.default_material) : code;
    gamma_.push_back(land.gamma[source]);
    cardinal_.push_back(land.cardinal[source]);
  }
}

double SceneSurface::wall_gamma(std::size_t code, double across, double towards) const {
  if (std::abs(across) > cutoff_tangent_ * towards) return gamma(code);
  const double off_deg = std::atan2(across, towards) / geo::kRadiansPerDegree;
  return gamma(code) * cardinal_gain(cardinal_[code % cardinal_.size()], off_deg, street_width_deg_);
}

double SceneSurface::steps_per_sine() const {
  return kSteps / std::sin(cutoff_deg_ * geo::kRadiansPerDegree);
}

std::vector<float> SceneSurface::cardinal_effect_table() const {
  std::vector<float> effects;
  for (int step = 0; step < kSteps; ++step) {
    const double off_deg = std::asin(std::min(step / steps_per_sine(), 1.0)) / geo::kRadiansPerDegree;
    effects.push_back(static_cast<float>(cardinal_gain(1.0, off_deg, street_width_deg_) - 1.0));
  }
  effects.push_back(0.0F);
  effects.push_back(0.0F);
  return effects;
}

namespace {
constexpr double kMaxState = 6.0;        // upper limit of the NRL model
constexpr double kShallowest_deg = 0.1;  // lower limit of the NRL model
constexpr double kSteepest_deg = 60.0;   // upper limit of the NRL model
constexpr double kSteepest_rad = kSteepest_deg * geo::kRadiansPerDegree;

// Maximum wind and WMO sea state of each Beaufort force from 1 to 6. Stronger wind gives state 6.
struct Force {
  double max_kt;
  double state;
};
constexpr std::array<Force, 6> kForces{{{3, 1}, {6, 2}, {10, 2}, {16, 3}, {21, 4}, {27, 5}}};

SeaCoefficients coefficients_of(const std::vector<double>& values) {
  SeaCoefficients coefficients{};
  std::copy_n(values.begin(), std::min(values.size(), coefficients.size()), coefficients.begin());
  return coefficients;
}
}  // namespace

double nrl_sigma0_db(const SeaCoefficients& c, double grazing_deg, double frequency_ghz, double sea_state) {
  const double a = grazing_deg;
  const double sine = std::sin(a * geo::kRadiansPerDegree);
  return c[0] + c[1] * std::log10(sine) + (27.5 + c[2] * a) * std::log10(frequency_ghz) / (1.0 + 0.95 * a) +
         c[3] * std::pow(1.0 + sea_state, 1.0 / (2.0 + 0.085 * a + 0.033 * sea_state)) + c[4] * a * a;
}

double SeaCorrection::db(double grazing_deg, double sea_state) const {
  const double held_deg = std::clamp(grazing_deg, kShallowest_deg, kSteepest_deg);
  const double x = std::log10(std::sin(held_deg * geo::kRadiansPerDegree));
  double sum = 0.0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i] + q[i] * sea_state;
  return sum;
}

SeaCorrection nathanson_correction(radar::Polarization polarization) {
  if (polarization == radar::Polarization::horizontal)
    return {{-4.845, 25.131, 57.583, 32.778, 5.558}, {0.774, -8.709, -16.637, -8.952, -1.462}};
  return {{-1.465, 21.321, 39.909, 21.868, 3.784}, {0.906, -3.619, -7.616, -4.202, -0.705}};
}

double sea_state_of_wind(geo::Speed wind) {
  const double wind_kt = std::round(wind.knots());  // the Beaufort scale has whole knots
  if (wind_kt < 1.0) return 0.0;
  for (const Force& force : kForces) {
    if (wind_kt <= force.max_kt) return force.state;
  }
  return kMaxState;
}

geo::Speed wind_of_sea_state(double state) {
  constexpr std::array<double, 7> kWind_mps{0.0, 2.5, 4.5, 6.0, 8.5, 11.0, 14.0};
  const double held = std::clamp(state, 0.0, kMaxState);
  const auto low = std::min(static_cast<std::size_t>(held), kWind_mps.size() - 2);
  return geo::Speed::metres_per_second(std::lerp(kWind_mps[low], kWind_mps[low + 1], held - static_cast<double>(low)));
}

double sea_slope_variance(geo::Speed wind) {
  return 0.003 + 0.00512 * wind.metres_per_second();
}

geo::Speed wave_speed(geo::Speed wind) {
  // The spectrum exp(-b (g / U w)^4) / w^5 has its peak at w = (4 b / 5)^(1/4) g / U. T = 2 pi / w.
  constexpr double kBeta = 0.74;
  return geo::Speed::metres_per_second(wind.metres_per_second() / std::pow(0.8 * kBeta, 0.25));
}

double specular_sigma0(double slope_variance, double sin_grazing) {
  const auto begin = static_cast<double>(kGlintSine);
  if (!(slope_variance > 0.0) || sin_grazing <= begin) return 0.0;
  const double square = std::min(sin_grazing * sin_grazing, 1.0);
  const double share = std::min(1.0, (sin_grazing - begin) * static_cast<double>(kGlintRise));
  return share * kSeaReflection / slope_variance / (square * square) *
         std::exp(-(1.0 - square) / square / slope_variance);
}

double upwind_db(double factor, double wavelength_m, double grazing_rad) {
  const double steepness = std::max(0.0, 1.0 - 2.8 * grazing_rad);
  return 10.0 * std::numbers::log10e * factor * steepness * std::pow(wavelength_m + 0.015, -0.4);
}

SeaReturn make_sea_return(const RadarParameters& parameters) {
  const radar::SeaConfiguration& settings = parameters.world.sea;
  SeaReturn sea;
  const bool horizontal = settings.polarization == radar::Polarization::horizontal;
  sea.coefficients = coefficients_of(horizontal ? settings.horizontal : settings.vertical);
  if (settings.model == radar::SeaModel::nathanson) sea.correction = nathanson_correction(settings.polarization);
  sea.frequency_ghz = parameters.frequency_ghz;
  sea.wavelength_m = wavelength_m(sea.frequency_ghz);
  const double state = std::isnan(settings.state)
                           ? sea_state_of_wind(geo::Speed::metres_per_second(settings.wind_speed_mps))
                           : settings.state;
  sea.state = std::clamp(state, 0.0, kMaxState);
  sea.wind_factor = settings.wind_factor;
  sea.wind_from = geo::Bearing::degrees(settings.wind_from_deg);
  const geo::Speed wind = std::isnan(settings.state) ? geo::Speed::metres_per_second(settings.wind_speed_mps)
                                                     : wind_of_sea_state(settings.state);
  sea.wind_mps = wind.metres_per_second();
  if (settings.specular) sea.slope_variance = sea_slope_variance(wind);
  return sea;
}

double sea_sigma0(const SeaReturn& sea, double sin_grazing, geo::Bearing azimuth) {
  if (!(sin_grazing > 0.0)) return 0.0;
  const double grazing_rad = std::min(std::asin(std::min(sin_grazing, 1.0)), kSteepest_rad);
  const double grazing_deg = grazing_rad / geo::kRadiansPerDegree;
  const double isotropic_db = nrl_sigma0_db(sea.coefficients, grazing_deg, sea.frequency_ghz, sea.state) +
                              sea.correction.db(grazing_deg, sea.state);
  const double upwind = upwind_db(sea.wind_factor, sea.wavelength_m, grazing_rad);
  return ratio(isotropic_db + upwind * std::cos((azimuth - sea.wind_from).radians())) +
         specular_sigma0(sea.slope_variance, sin_grazing);
}

SeaTable make_sea_table(const SeaReturn& all) {
  SeaTable table;
  SeaReturn sea = all;
  sea.slope_variance = 0.0;  // the vector code adds the specular echo
  const geo::Bearing across = sea.wind_from + geo::Angle::degrees(90.0);
  for (std::size_t i = 0; i < table.across.size(); ++i) {
    const auto bits = SeaTable::kFirst + (static_cast<std::uint32_t>(i) << SeaTable::kShift);
    const auto sine = static_cast<double>(std::bit_cast<float>(bits));
    const double octaves = std::log2(sea_sigma0(sea, sine, across));
    table.across[i] = static_cast<float>(octaves);
    table.upwind[i] = static_cast<float>(std::log2(sea_sigma0(sea, sine, sea.wind_from)) - octaves);
  }
  return table;
}

}  // namespace yars::model::physics
