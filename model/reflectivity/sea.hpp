// What the sea returns: the NRL model of Gregers-Hansen and Mital 2012 (DTIC ADA559494), 0.1 to 60 degrees grazing,
// sea states 0 to 6, within 2.6 dB on average of Nathanson's tables, which average over the wind. The
// wind's side is that of the GIT model (Horst, Dyer, Tuley 1978): 3 dB more upwind, less downwind, at X band.
#pragma once

#include <array>
#include <span>

#include "lib/geo/bearing.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::model::reflectivity {

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

}  // namespace yars::model::reflectivity
