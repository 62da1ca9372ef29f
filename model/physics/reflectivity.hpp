// Reflectivity of land, scene faces and sea.
// Inputs: surface material codes, grazing angles, azimuth of the ray, frequency, sea state and wind.
// Outputs: gamma and sigma0 as power ratios; directions of streets [deg].
// Accuracy: SeaTable within 0.05 dB of sea_sigma0() from 0.02 to 15 degrees grazing.
// Unknown material codes reflect as land without culture.
// Threads: one thread at a time may use a StreetFinder.
// Source: docs/spec/physics.md#land, docs/spec/physics.md#sea.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/radar_parameters.hpp"

namespace yars::radar {
struct LandConfiguration;
}  // namespace yars::radar

namespace yars::model::physics {

inline double ratio(double decibels) {
  return std::pow(10.0, 0.1 * decibels);
}

inline constexpr double kSpeedOfLight = 299792458.0;  // [m/s] exact

inline double wavelength_m(double frequency_ghz) {
  return kSpeedOfLight / (frequency_ghz * 1e9);
}

// Area a few kilometres wide in which all streets follow one rectangular grid. Patches depend on position alone, not on
// the loaded terrain. So synthetic and real culture at one position have equal streets and an equal cardinal effect.
// The cardinal effect is the strong return of walls that face the radar.
struct StreetPatch {
  geo::GeoPoint origin;      // a crossing of the patch's street grid
  double bearing_deg = 0.0;  // true bearing in [0, 90) of one set of streets; the second set is perpendicular
};

// Patch with the origin nearest to a position. There is about one origin per 5 x 5 km.
StreetPatch street_patch(geo::GeoPoint position);

inline double street_bearing_deg(geo::GeoPoint position) {
  return street_patch(position).bearing_deg;
}

// Finds the street patches of successive positions. The patches around the last position are cached.
class StreetFinder {
 public:
  StreetPatch patch(geo::GeoPoint position);
  double bearing_deg(geo::GeoPoint position) { return nearest(position).bearing_deg; }

 private:
  static constexpr std::int32_t kNoRow = -10;
  struct Row {
    int columns = 1;                          // number of patches round the earth
    double column_deg = 0.0;                  // width in longitude
    int middle = kNoRow;                      // column of the middle neighbour
    std::array<StreetPatch, 3> neighbours{};  // longitudes are continuous across the antimeridian
  };
  const StreetPatch& nearest(geo::GeoPoint position);
  void use_row(std::int32_t middle_row);
  void use_column(Row& row, std::int32_t number, int middle);

  std::int32_t middle_row_ = kNoRow;
  std::array<Row, 3> rows_{};
};

// Land return: sigma0 = gamma sin(psi), with gamma by surface material and psi the grazing angle. Walls that face the
// radar return more (cardinal effect). Gammas are power ratios at the radar's frequency.
// Source: docs/spec/physics.md#land; constant-gamma model after Barton, "Modern Radar System Analysis".

// Frequency term of gamma [dB]: slope * log10(f / reference). The default slope is 5 dB a decade.
double frequency_term_db(const radar::LandConfiguration& land, double frequency_ghz);

// Land coefficients by material code. Codes without a material have the coefficients of land without culture.
struct LandReturn {
  std::array<double, radar::kMaterials> gamma{};
  // Relative increase of gamma by a wall perpendicular to the ray; 0: no walls.
  std::array<double, radar::kMaterials> cardinal{};
  double cardinal_width_deg = 6.0;  // `width_deg` of cardinal_gain()
};
LandReturn make_land_return(const RadarParameters& parameters);

// Angle in [-45, 45), clockwise positive, from the nearest direction of a street grid to a ray's azimuth. Walls stand
// along and across the streets.
double off_street_deg(double azimuth_deg, double street_deg);

// Factor on gamma by the cardinal effect: 1 + cardinal * exp(-4 ln 2 (off / width)^2). `width_deg` is the full width at
// half maximum.
double cardinal_gain(double cardinal, double off_deg, double width_deg);

// Reflectivity of scene faces by surface material code.
class SceneSurface {
 public:
  explicit SceneSurface(const RadarParameters& parameters);

  // Codes are taken modulo radar::kMaterials. Code 0 has the gamma of the configured default material.
  double gamma(std::size_t code) const { return gamma_[code % gamma_.size()]; }
  // Gamma of a wall with the cardinal effect. `towards` and `across` are the components of the wall's horizontal normal
  // along and perpendicular to the direction to the radar.
  double wall_gamma(std::size_t code, double across, double towards) const;

  double street_width_deg() const { return street_width_deg_; }
  double cutoff_tangent() const { return cutoff_tangent_; }
  double cardinal(std::size_t code) const { return cardinal_[code % cardinal_.size()]; }
  // Table of the cardinal effect, 1 at angle 0, over the sine of the angle off the wall's normal. Entry i is at the
  // sine i / steps_per_sine(). The last two entries are 0.
  std::vector<float> cardinal_effect_table() const;
  double steps_per_sine() const;

 private:
  std::vector<double> gamma_, cardinal_;
  double street_width_deg_;
  double cutoff_deg_;
  double cutoff_tangent_;  // tangent of cutoff_deg_, the angle beyond which the cardinal effect is 0
};

// Upper limit of shading, a factor on gamma: the cosine of the angle between ray and interpolated normal, divided by
// the cosine of the angle between ray and facet's normal. The ratio diverges where the radar sees a facet edge-on.
inline constexpr double kMaxShading = 4.0;

// Sea return. Source: NRL model, Gregers-Hansen and Mital 2012 (DTIC ADA559494), 0.1 to 60 degrees grazing, sea states
// 0 to 6. The model is within 2.6 dB on average of Nathanson's tables, which average over the wind direction. A
// correction fitted to Nathanson's table at 9.3 GHz brings it within 1.1 dB there.
// The wind direction term is from the GIT model (Horst, Dyer, Tuley 1978). At X band, low grazing
// angles and the default wind factor: 3 dB upwind, -3 dB downwind.

using SeaCoefficients = std::array<double, 5>;

// sigma0 [dB] = c1 + c2 lg sin a + (27.5 + c3 a) lg f / (1 + 0.95 a) + c4 (1 + SS)^(1/(2 + 0.085 a + 0.033 SS)) +
//               c5 a^2
// a is the grazing angle [deg], f the frequency [GHz], SS the sea state, lg the logarithm to base 10.
double nrl_sigma0_db(const SeaCoefficients& c, double grazing_deg, double frequency_ghz, double sea_state);

// Correction of nrl_sigma0_db() [dB], with its default coefficients, to Nathanson's table at 9.3 GHz, from 8 to 12 GHz:
// sum of (p[i] + q[i] S) x^i, x = lg sin a, S the sea state. Below 0.1 and above 60 degrees it is held.
// Source: fit by lab/fit_sea to F. E. Nathanson, Radar Design Principles, 2nd ed., as tabulated in DTIC ADA559494.
struct SeaCorrection {
  std::array<double, 5> p{}, q{};

  double db(double grazing_deg, double sea_state) const;
};
SeaCorrection nathanson_correction(radar::Polarization polarization);

// Sea state (WMO code 3700) in [0, 6] of a wind by the Beaufort scale. Example: force 3, 7 to 10 kt, is state 2.
double sea_state_of_wind(geo::Speed wind);

// Upwind term of sigma0 [dB]: 10 lg e * factor (1 - 2.8 psi) (lambda + 0.015)^-0.4, with the wavelength lambda [m]. The
// term is 0 if the grazing angle psi exceeds 1/2.8 rad (20 degrees). At other azimuths it is multiplied by the cosine
// of the angle between the ray and the direction that the wind comes from.
double upwind_db(double factor, double wavelength_m, double grazing_rad);

// Parameters of the sea return, from the configuration.
struct SeaReturn {
  SeaCoefficients coefficients{};
  SeaCorrection correction;  // 0 by the NRL model
  double frequency_ghz = 0.0;
  double wavelength_m = 0.0;
  double state = 0.0;        // sea state [0, 6]
  double wind_factor = 0.0;  // `factor` of upwind_db()
  geo::Bearing wind_from;
  double wind_mps = 0.0;        // of the configuration, or that of the configured state
  double slope_variance = 0.0;  // of the specular echo; 0: no such echo
};
SeaReturn make_sea_return(const RadarParameters& parameters);

// Wind that makes a sea state from 0 to 6, by interpolation. Source: table of M. Farshchian, NRL 2010.
geo::Speed wind_of_sea_state(double state);

// Variance of the slopes of a clean sea: 0.003 + 0.00512 W, W the wind [m/s]. Source: Cox and Munk 1954.
double sea_slope_variance(geo::Speed wind);

// Speed of the crests of the longest waves of a fully developed sea in deep water: c = g T / 2 pi, at the peak of the
// Pierson-Moskowitz spectrum.
geo::Speed wave_speed(geo::Speed wind);

// Echo of facets of the sea that are normal to the ray: |R|^2 / s^2 sec^4 t exp(-tan^2 t / s^2), t from the vertical,
// s^2 the variance of slopes. It begins at 60 degrees grazing, where the models of sigma0 end, and is whole from 70.
// Source: Barrick 1968, in the form of docs/spec/physics.md#sea.
double specular_sigma0(double slope_variance, double sin_grazing);
inline constexpr float kGlintSine = 0.866025404F;           // sin 60
inline constexpr float kGlintRise = 1.0F / 0.07366721667F;  // 1 / (sin 70 - sin 60)
inline constexpr double kSeaReflection = 0.61;              // |R|^2 of sea water at X band (chosen)

// sigma0 (power ratio) at a grazing angle and an azimuth of the ray. Above 60 degrees grazing, it is that at 60 and the
// specular echo. Below 0.1 degrees the formula is extrapolated. 0 if sin_grazing <= 0.
double sea_sigma0(const SeaReturn& sea, double sin_grazing, geo::Bearing azimuth);

// Table of the sea's sigma0 over the sine of the grazing angle. Each octave of the sine has sixteen pieces. Within a
// piece sigma0 is interpolated linearly. The upper bits of the sine as a float select the piece. Below the first entry
// sigma0 is proportional to the sine.
// Accuracy against sea_sigma0(): 0.02 dB (0.05 with a correction) from 0.02 to 15 degrees, 0.2 dB to 55, 0.4 dB at 60
// degrees, where the NRL model ends.
// Entries are logarithms, so each azimuth takes one exp2 per entry.
struct SeaTable {
  static constexpr std::uint32_t kFirst = (127U - 12U) << 23U;  // bits of 2^-12: 0.014 degrees
  static constexpr std::uint32_t kShift = 19U;                  // sixteen pieces per octave
  static constexpr std::size_t kPieces = 192;                   // twelve octaves, to the sine of 90 degrees

  std::array<float, kPieces + 1> across{};  // log2 of sigma0 across the wind
  std::array<float, kPieces + 1> upwind{};  // log2(sigma0 upwind / sigma0 across); see simd::sigma0_at_azimuth()
};
SeaTable make_sea_table(const SeaReturn& sea);

}  // namespace yars::model::physics
