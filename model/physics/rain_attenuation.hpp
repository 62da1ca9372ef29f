// Specific attenuation of rain: k r^alpha dB/km one way, at the rain rate r [mm/h].
// Inputs: frequency from 1 to 1000 GHz, polarization, elevation of the ray; or a configuration, which may give k and
//   alpha.
// Outputs: k and alpha; attenuation [dB/m].
// Accuracy: the examples of the ITU to all of their eight digits.
// Source: ITU-R P.838-3; docs/spec/physics.md#rain.
#pragma once

#include "model/physics/radar_parameters.hpp"

namespace yars::model::physics {

struct RainLaw {
  double factor = 0.0;    // k [dB/km]
  double exponent = 0.0;  // alpha
};

// Law of ITU-R P.838-3 for a linear polarization: `tilt_rad` is 0 for horizontal, pi/2 for vertical. Rays are level
// where `elevation_rad` is 0.
RainLaw rain_law(double frequency_ghz, double tilt_rad, double elevation_rad);

// k and alpha of the configuration. Each that it omits is that of P.838-3 at the radar's frequency and polarization,
// for level rays.
RainLaw configured_rain_law(const RadarParameters& parameters);

// One-way attenuation at a rain rate.
double rain_attenuation_db_per_m(const RainLaw& law, double rate_mmh);

}  // namespace yars::model::physics
