// Lobes of a target over the sea: the direct ray and the one that the sea reflects add by their phases, on the way to
// the target and back. Inputs: height of the target above the sea, and its extent in height, its direction by the earth
// of the sweep; wavelength, polarization, wind. Outputs: factor on the power of the echo, from 0 to 16. Accuracy: for
// targets far lower than the aircraft. The reflection lies near the target; the sea is level there. Threads: any thread
// may call any function. Source: Skolnik, "Introduction to Radar Systems", 3rd ed., 8.2: F^4 = |1 + rho exp(-j
// phase)|^4; Ament 1953: a rough sea reflects rho exp(-2 (2 pi s sin(grazing) / wavelength)^2), s the standard
// deviation of its height.
#pragma once

#include <complex>

#include "lib/radar/modes.hpp"
#include "model/physics/radar_parameters.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

// Fresnel's reflection by sea water at a grazing angle. Permittivity 65 - 37 j (chosen: sea water at 10 GHz, 20 deg C).
std::complex<double> sea_reflection(radar::Polarization polarization, double sin_grazing);

// Standard deviation of the height of a fully developed sea [m]: a quarter of the significant wave height,
// 0.21 W^2 / g (Pierson and Moskowitz 1964).
double sea_height_m(geo::Speed wind);

class SeaMirror {
 public:
  explicit SeaMirror(const RadarParameters& parameters);

  bool works() const { return works_; }  // false: without the slot seaLobes, lobe_factor() is 1
  // `height_m`: of the target's middle above the sea, `distance_m` over ground. The cross section is even over
  // `extent_m` of height; the factor is its mean.
  double lobe_factor(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                     double extent_m = 0.0) const;

 private:
  bool works_;
  radar::Polarization polarization_;
  double wavelength_m_, roughness_m_;
};

}  // namespace yars::model::physics
