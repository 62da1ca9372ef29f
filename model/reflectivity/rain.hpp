// What rain returns and takes: volume reflectivity and attenuation by rate, and the profile across a shower, whose
// closed integral serves the ray. Sources: Z = a r^b, Marshall and Palmer 1948; eta = pi^5 |K|^2 Z / lambda^4, Probert-
// Jones 1962; k r^b, ITU-R P.838-3. The profile (1 - (rho/radius)^2)^2 is a project choice: a soft rim, a closed
// integral.
#pragma once

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::model::reflectivity {

// Backscatter of a volume [m^2/m^3] at a rate [mm/h].
double rain_reflectivity(const radar::RainConfiguration& rain, double rate_mmh, double wavelength_m);

// One-way attenuation [dB/m] at a rate [mm/h].
double rain_attenuation_db_per_m(const radar::RainConfiguration& rain, double rate_mmh);

// How a ray over ground cuts a shower. Distances [m] over ground from the aircraft; the profile of what the middle
// returns and takes is (depth - ((d - middle) / radius)^2)^2 within `half` of the middle.
struct RainChord {
  double middle_m = 0.0;
  double half_m = 0.0;  // 0: the ray misses
  double depth = 0.0;   // root of the profile where the ray is nearest to the shower's middle
  double radius_m = 0.0;

  double profile(double distance_m) const;
  // Integral of the profile [m] between two distances.
  double integral_m(double from_m, double to_m) const;
};
RainChord rain_chord(geo::GeoPoint apex, geo::Bearing azimuth, geo::GeoPoint middle, double radius_m);

}  // namespace yars::model::reflectivity
