// Radar equation of one sample: illuminated area, antenna gain, sensitivity time control, pulse smear.
// Inputs: cross section [m^2], slant range [m], angles [rad], configuration at one selected range.
// Outputs: power relative to full scale. Elevations are positive above the horizontal.
// Accuracy: closed forms in double precision.
// Source: docs/spec/physics.md#power, docs/spec/physics.md#receiver, docs/spec/physics.md#beam.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/radar_parameters.hpp"

namespace yars::model::physics {

// Constants of transmitter, antenna and receiver at one selected range, as plain numbers for hot loops.
struct Receiver {
  double azimuth_beamwidth_rad = 0.0;
  double azimuth_cell_rad = 0.0;  // width of the clutter cell: azimuth_cell_rad()
  double elevation_beamwidth_rad = 0.0;
  double pulse_length_m = 0.0;  // c tau / 2, extent of a pulse in range; tau is its duration
  double land_gamma = 0.0;      // sigma0 / sine of the grazing angle, of land without culture
  double range_m = 0.0;         // the selected range
  double stc_exponent = 0.0;    // n: sensitivity time control multiplies power by (slant range / kFullScaleRange)^n
  double full_scale = 0.0;      // [1/m^2] value of returned_power() at full scale, see Receivers::at()
  double noise = 0.0;           // power of thermal noise before sensitivity time control, full scale = 1
  bool automatic_gain = false;
  double dynamic_range_db = 0.0;  // black to white
  double gain_step_db = 0.0;
  int looks = 0;  // 1..kMaxLooks, independent looks averaged in a sample; 0: by Doppler
  double wavelength_m = 0.0;
  double dwell_s = 0.0;            // of the scanning beam on a point: the beamwidth over the scan rate
  double sharpened_dwell_s = 0.0;  // of Doppler beam sharpening
};

// c / 2 times 1 us: slant range per microsecond of echo delay, pulse length per microsecond of pulse duration.
inline constexpr double kMetresPerMicrosecond = 149.896229;
// Slant range at which full scale and noise are defined and sensitivity time control is 1: the middle range scale.
inline constexpr geo::Length kFullScaleRange = geo::Length::nautical_miles(40.0);
inline constexpr int kMaxLooks = 16;
inline constexpr int kFullGain = 3;  // GAIN 3 is full gain; each lower step is gain_step_db less

// Makes the receiver of any selected range. Owns copies of the configured values.
class Receivers {
 public:
  explicit Receivers(const RadarParameters& parameters);

  // Full scale is the return of land of the configured gamma at 45 degrees grazing, in the beam's centre, at
  // kFullScaleRange, with the pulse of the selected range. Thermal noise is proportional to the bandwidth, 1 / tau, so
  // the cross section that equals noise is proportional to R^4 / tau.
  Receiver at(geo::Length range) const;

  // Pulse length c tau / 2 of the smallest configured range that is not less than `range`. Beyond the last range the
  // last pulse applies.
  geo::Length pulse_length(geo::Length range) const;

 private:
  std::vector<double> ranges_nm_, pulse_us_;
  Receiver receiver_;  // without the constants that depend on the range
};

// Number of independent looks, 1 to kMaxLooks, of a beam `width` wide in azimuth that dwells for `dwell_s`, at an angle
// off the ground track. The ground's Doppler shifts spread over B = 2 V width sin(angle) / wavelength, so that the echo
// changes B times a second. A configured number replaces it.
// Source: Skolnik, "Introduction to Radar Systems", 3rd ed., 7.2: fluctuation of clutter seen from a moving platform.
int looks_of(const Receiver& receiver, double width_rad, double dwell_s, geo::Speed ground_speed, geo::Angle off_track);

// Length over level ground that returns at one time [m]: the smaller of the pulse-limited (c tau / 2) / cos psi and the
// beam-limited R theta_el / sin psi. Grazing angle psi in [0, 90] degrees.
double illuminated_length_m(const Receiver& receiver, double slant_range_m, double sin_grazing);

// Power [1/m^2] of a target before sensitivity time control: sigma G^2 / R^4. sigma is the cross section, G^2 the
// two-way gain, R the slant range.
double returned_power(double cross_section_m2, double two_way_gain, double slant_range_m);

// Two-way gain at an elevation, 1 in the beam's centre. `antenna_elevation_rad` is the elevation of the centre. delta
// >= 0 is the angle off the centre, upwards or downwards; theta is the beamwidth.
// gaussian: exp(-5.545 (delta / theta)^2). hard_edge: 1 within half a beamwidth, else 0.
// mapping: Gaussian above the centre; (sin b / sin(b + delta))^4 below it: one-way csc^2, with which flat land of
// constant gamma returns equal power from every range. cosecant_squared: the same with the exponent 2.
// b is the depression of the centre, but at least half a beamwidth.
// Source: Skolnik, "Introduction to Radar Systems", 3rd ed., 9.11: cosecant-squared antenna pattern.
double two_way_gain(radar::BeamPattern pattern, double beamwidth_rad, double antenna_elevation_rad,
                    double elevation_rad);

// Integral of two_way_gain() over elevation from `from_rad` to `to_rad` [rad], both at least -90 degrees. 0 if
// to_rad <= from_rad.
double beam_integral(radar::BeamPattern pattern, double beamwidth_rad, double antenna_elevation_rad, double from_rad,
                     double to_rad);

// Two-way gain at an azimuth off the beam's centre: Gaussian for every pattern.
double azimuth_gain(double beamwidth_rad, double offset_rad);

// Integral of azimuth_gain() over all azimuths [rad]: 0.753 beamwidths. Ground returns as if the gain were 1 over this
// width. Source: Ulaby, Moore, Fung, "Microwave Remote Sensing" II, 7-2: illuminated area of a beam.
double azimuth_cell_rad(double beamwidth_rad);

// Power relative to full scale after sensitivity time control. `power` is a result of returned_power().
double received(const Receiver& receiver, double power, double slant_range_m);

// Sensitivity time control: factor on everything that is received at a slant range, noise and jamming included.
double time_control(const Receiver& receiver, double slant_range_m);

// Automatic gain [dB]: with it, level land of the configured gamma at half the selected range is kLandLevel_db below
// white from every altitude. Limited to [-30, 40]. 0 if it is switched off.
inline constexpr double kLandLevel_db = 20.0;
double automatic_gain_db(const Receiver& receiver, radar::BeamPattern pattern, geo::AltitudeMsl altitude,
                         geo::Angle antenna_elevation);

// Exponent of the two-way Gaussian, 8 ln 2: gain 1/4 (-6 dB two-way) at half a beamwidth from the centre.
inline constexpr double kTwoWayExponent = 5.545;

// A sample is the mean power over its cell of ranges, of the return that each range of the cell receives: the mean over
// one pulse. So the ground at the offset u from the middle of the cell has the weight K(u): the convolution of the
// cell, 1 sample long, with the pulse. pulse_weight() is the integral of K up to an offset. It is 0 far below the cell
// and 1 far above it. Offsets and the length of the pulse are in samples; a length of 0 is no smear.
double pulse_weight(double pulse_samples, double offset_samples);

// Pulse smear: weights of the samples that a pulse covers, at the offsets -reach..reach [samples] from its middle. The
// sum of weights is 1. Power is taken as even within each sample.
struct PulseSmear {
  static constexpr std::ptrdiff_t kMaxRadius = 32;  // [samples] limits the pulse to 63 samples
  std::ptrdiff_t reach = 0;
  std::array<double, 2 * kMaxRadius + 1> weights{};
};
PulseSmear make_pulse_smear(double pulse_samples);

// Factor on the power of a point target before the smear: the pulse length in samples, at most 63, because the smear
// divides by that length. Without smear it is 1. Ground fills the pulse and needs no factor.
double point_smear_gain(double pulse_samples);

}  // namespace yars::model::physics
