// Reflectivity of land, scene faces and sea, as power ratios.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::model::physics {

// Power ratios and decibels.
inline double ratio(double decibels) {
  return std::pow(10.0, 0.1 * decibels);
}

inline constexpr double kSpeedOfLight = 299792458.0;  // [m/s] exact

inline double wavelength_m(double frequency_ghz) {
  return kSpeedOfLight / (frequency_ghz * 1e9);
}

// How streets lie: towns everywhere are laid out in patches of a few kilometres, each with one direction of its own.
// A pure function of place, the same whatever database is loaded, so that walls face the radar (the cardinal effect)
// alike over made-up and over real culture.
struct StreetPatch {
  geo::GeoPoint origin;      // a corner of the patch's grid of streets
  double bearing_deg = 0.0;  // [0, 90) of one set of streets; the other is at right angles
};

// The patch that holds a place: the nearest of scattered origins, about one to 5 x 5 km.
StreetPatch street_patch(geo::GeoPoint place);

inline double street_bearing_deg(geo::GeoPoint place) {
  return street_patch(place).bearing_deg;
}

// The same for places one after the other: the patches about the last one are remembered.
class StreetFinder {
 public:
  StreetPatch patch(geo::GeoPoint place);
  double bearing_deg(geo::GeoPoint place) { return nearest(place).bearing_deg; }

 private:
  static constexpr std::int32_t kNoRow = -10;
  struct Row {
    int columns = 1;                          // round the earth: a row of patches has as many as fit
    double column_deg = 0.0;                  // [deg] of longitude
    int middle = kNoRow;                      // the column that the neighbours are about
    std::array<StreetPatch, 3> neighbours{};  // their longitudes run on across the antimeridian
  };
  const StreetPatch& nearest(geo::GeoPoint place);
  void use_row(std::int32_t middle_row);
  void use_column(Row& row, std::int32_t number, int middle);

  std::int32_t middle_row_ = kNoRow;
  std::array<Row, 3> rows_{};
};

// What land returns: sigma0 = gamma sin(psi), gamma by surface material, 5 dB more a decade of frequency. Walls that
// face the radar return more (cardinal effect). Gammas are power ratios at the radar's frequency.
// Source: docs/spec/physics.md#land; the constant-gamma model after Barton, "Modern Radar System Analysis".

// What is added to every gamma [dB] at this frequency: slope * log10(f / reference).
double frequency_term_db(const radar::LandConfiguration& land, double frequency_ghz);

// By material code; a code without a material returns what land without culture returns.
struct LandReturn {
  std::array<double, radar::kMaterials> gamma{};
  std::array<double, radar::kMaterials> cardinal{};  // power ratio less 1, at walls square to the look; 0 = no walls
  double street_width_deg = 6.0;
};
LandReturn make_land_return(const radar::RadarConfiguration& configuration);

// Angle [deg] in [-45, 45) between a look and the nearest direction of a street grid, whose walls stand square to it.
double off_street_deg(double look_deg, double street_deg);

// Factor on gamma: 1 + cardinal * exp(-4 ln 2 (off / width)^2), the width between half powers.
double cardinal_gain(double cardinal, double off_deg, double width_deg);

// What the faces of a scene return, by their surface material code.
class SceneSurface {
 public:
  explicit SceneSurface(const radar::RadarConfiguration& configuration);

  // By material code, whatever its number; 0 stands for the configured plain material.
  double gamma(std::size_t code) const { return gamma_[code % gamma_.size()]; }
  // The same of a wall whose horizontal normal is so far off the direction to the radar: `across` against `towards`.
  double wall_gamma(std::size_t code, double across, double towards) const;

  double cardinal(std::size_t code) const { return cardinal_[code % cardinal_.size()]; }
  // What a wall returns more than gamma, over gamma times cardinal(): by the sine of its angle off, in even steps from
  // 0, an entry more than steps; 0 behind the last.
  std::vector<float> cardinal_shares() const;
  double steps_a_sine() const;

 private:
  std::vector<double> gamma_, cardinal_;
  double street_width_deg_;
  double faded_deg_;
  double faded_tangent_;  // of the angle beyond which nothing of the cardinal effect is left
};

inline constexpr double kMaxShading = 4.0;  // of an interpolated normal against the facet's: silhouettes are ragged

// What the sea returns: the NRL model of Gregers-Hansen and Mital 2012 (DTIC ADA559494), 0.1 to 60 degrees grazing,
// sea states 0 to 6, within 2.6 dB on average of Nathanson's tables, which average over the wind. The
// wind's side is that of the GIT model (Horst, Dyer, Tuley 1978): 3 dB more upwind, less downwind, at X band.

using SeaCoefficients = std::array<double, 5>;

// sigma0 [dB] = c1 + c2 lg sin a + (27.5 + c3 a) lg f / (1 + 0.95 a) + c4 (1 + SS)^(1/(2 + 0.085 a + 0.033 SS)) + c5
// a^2, a the grazing angle in degrees, f in GHz.
double nrl_sigma0_db(const SeaCoefficients& c, double grazing_deg, double frequency_ghz, double sea_state);

// State of the sea (WMO code 3700) [0, 6] that goes with a wind by the Beaufort scale: force 3, 7 to 10 kt, is state 2.
double sea_state_of_wind(geo::Speed wind);

// Decibels to be added looking straight upwind; times the cosine of the angle off the wind for another look:
// 10 lg e * factor (1 - 2.8 psi) (lambda + 0.015)^-0.4, nothing where psi is beyond 1/2.8 rad (20 degrees).
double upwind_db(double factor, double wavelength_m, double grazing_rad);

// The configured sea.
struct SeaReturn {
  SeaCoefficients coefficients{};
  double frequency_ghz = 0.0;
  double wavelength_m = 0.0;
  double state = 0.0;
  double wind_factor = 0.0;
  geo::Bearing wind_from;
};
SeaReturn make_sea_return(const radar::RadarConfiguration& configuration);

// sigma0 (ratio) under a grazing angle of this sine, looking this way. Steeper than 60 degrees as at 60; below 0.1
// degrees the formula goes on; 0 where the sea turns its back.
double sea_sigma0(const SeaReturn& sea, double sin_grazing, geo::Bearing look);

// The sea's sigma0 over the grazing angle as a table, for loops over the samples of a sweep: piecewise linear over the
// sine, sixteen pieces an octave, found from the bits of the float alone. Within 0.02 dB of sea_sigma0() from 0.02 to
// 15 degrees, 0.2 dB to 55, 0.4 dB where the model ends at 60. What does not depend on the look is computed once, as
// octaves: a sweep costs one exp2 an entry. Below the first entry sigma0 falls as the sine.
struct SeaTable {
  static constexpr std::uint32_t kFirst = (127U - 12U) << 23U;  // bits of 2^-12: 0.014 degrees
  static constexpr std::uint32_t kShift = 19U;                  // sixteen pieces an octave
  static constexpr std::size_t kPieces = 192;                   // twelve octaves, to the sine of 90 degrees

  std::array<float, kPieces + 1> across{};  // log2 of sigma0 looking across the wind
  std::array<float, kPieces + 1> upwind{};  // octaves more looking upwind; times the cosine of the angle off the wind
};
SeaTable make_sea_table(const SeaReturn& sea);

}  // namespace yars::model::physics
