// What the transmitter, the antenna and the receiver make of a return: the radar equation at image level, shared by
// all algorithms as plain numbers. Source: docs/spec/physics.md#power, #receiver.
#pragma once

#include <array>
#include <cstddef>

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::model::physics {

// The configuration at one selected range, unwrapped for hot loops.
struct Receiver {
  double azimuth_beamwidth_rad = 0.0;
  double elevation_beamwidth_rad = 0.0;
  double pulse_length_m = 0.0;  // [m] c tau / 2: what one pulse covers in range
  double land_gamma = 0.0;      // power ratio
  double stc_exponent = 0.0;
  double stc_range_m = 0.0;         // [m] R0, where the sensitivity time control is 1
  double full_scale = 0.0;          // [1/m^2] power of returned_power() that counts as 1, see below
  double noise = 0.0;               // thermal noise, full scale = 1
  double decibels_per_scale = 0.0;  // [dB] black to white
  double gain_step_db = 0.0;
  int looks = 1;  // 1..kMaxLooks
};

inline constexpr int kMaxLooks = 16;
inline constexpr int kFullGain = 3;  // GAIN 3 is full gain; each step below takes gain_step_db off

// Full scale is land of the configured gamma on a facet under 45 degrees in the beam's centre at the far end of the
// range: the brightest that open country gives; what is brighter clips.
Receiver make_receiver(const radar::RadarConfiguration& configuration, geo::Length range);

// Pulse length c tau / 2 at a selected range: that of the smallest configured range which holds it.
geo::Length pulse_length(const radar::RadarConfiguration& configuration, geo::Length range);

// Ground lit at once [m^2]: pulse limited R theta (c tau / 2) / cos psi or beam limited R^2 theta_az theta_el / sin
// psi, whichever is smaller. Grazing in (0, 90] degrees.
double illuminated_area_m2(const Receiver& receiver, double slant_range_m, double sin_grazing);

// Power of a target of this cross section under the two-way gain, before sensitivity time control: sigma G^2 / R^4.
double returned_power(double cross_section_m2, double two_way_gain, double slant_range_m);

// Two-way gain (1 in the beam's centre) at an elevation, with the antenna at another. Gaussian: exp(-5.545
// (delta/theta)^2); hard edge: 1 within half a beam width; csc^2: gaussian above the centre, below it
// (sin b / sin(b + a))^2 at a below the centre, with b the depression of the centre, at least half a beam width.
double two_way_gain(radar::BeamPattern pattern, double beamwidth_rad, double antenna_elevation_rad,
                    double elevation_rad);

// Its integral over elevation [rad] between two elevations, from -90 degrees on: how much of the beam a volume fills.
double beam_integral(radar::BeamPattern pattern, double beamwidth_rad, double antenna_elevation_rad, double from_rad,
                     double to_rad);

// Two-way gain at an azimuth off the beam's centre: gaussian in every pattern.
double azimuth_gain(double beamwidth_rad, double off_rad);

// What sensitivity time control and full scale make of a power from this slant range.
double received(const Receiver& receiver, double power, double slant_range_m);

// Exponent of the two-way gaussian, 8 ln 2: a quarter (-6 dB, both ways) at half a beam width from the centre.
inline constexpr double kTwoWayExponent = 5.545;

// Pulse smear: weights over samples -reach..reach of a pulse of this many samples, sum 1. A pulse shorter than a
// sample smears nothing.
struct PulseSmear {
  static constexpr std::ptrdiff_t kMaxReach = 32;  // samples; a longer pulse is cut
  std::ptrdiff_t reach = 0;
  std::array<double, 2 * kMaxReach + 1> weights{};
};
PulseSmear make_pulse_smear(double pulse_samples);

// By how much a point has to be raised before the smear: it is seen whole for as long as the pulse covers it, while
// ground fills the pulse. At least 1.
double point_rise(double pulse_samples);

}  // namespace yars::model::physics
