// Atmosphere: attenuation by gases along a ray; return and attenuation of rain.
// Inputs: frequency; effective earth; altitude of the aircraft, height of a point (both above mean sea level) and its
//   distance over ground [m]; rain cells.
// Outputs: attenuation [dB, dB/km, dB/m], factors on power, power returned by rain [1/m^2].
// Accuracy: GasSamples within 0.1 dB of GasPath.
// Threads: GasPath and GasProfile are immutable; GasSamples and RainPath have buffers: one object per thread.
// Source: docs/spec/physics.md#gases, docs/spec/physics.md#rain.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/line_vector.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::radar {
struct AtmosphereConfiguration;
struct RainConfiguration;
}  // namespace yars::radar

namespace yars::model::physics {

// State of the air at one height.
struct Air {
  double temperature_k = 0.0;
  double dry_hpa = 0.0;     // pressure of dry air, without water vapour
  double water_g_m3 = 0.0;  // density of water vapour
};

double vapour_hpa(const Air& air);  // partial pressure of water vapour

// Specific attenuation, one way [dB/km].
struct GasAttenuation {
  double dry = 0.0;
  double water = 0.0;
};

// Specific attenuation at a frequency from 1 to 1000 GHz, summed over spectral lines and the dry continuum.
// Source: ITU-R P.676-13, Annex 1, section 1.
GasAttenuation gas_attenuation(double frequency_ghz, const Air& air);

// Reference atmosphere at a height above mean sea level, up to 32 km. The formulas extend below sea level.
// Source: mean annual global reference atmosphere, ITU-R P.835, Annex 1.
Air reference_air(const radar::AtmosphereConfiguration& atmosphere, double height_m);

// Table of one-way attenuation over height at one frequency, linear between heights 100 m apart.
class GasProfile {
 public:
  // Empty if the configuration switches gases off.
  GasProfile(const radar::AtmosphereConfiguration& atmosphere, double frequency_ghz);

  bool empty() const { return db_per_m_.empty(); }
  // One-way attenuation at a height above mean sea level; 0 if empty. Heights are clamped to [-1, 30] km.
  double db_per_m(double height_m) const;

 private:
  std::vector<double> db_per_m_;
};

// Attenuation by gases along rays from the aircraft: GasProfile integrated over the ray.
// The ray's height is taken as a parabola in distance that has the ray's mean bending (EffectiveEarth::sag_m()).
class GasPath {
 public:
  explicit GasPath(const RadarParameters& parameters);

  // True if gases are switched off.
  bool none() const { return profile_.empty(); }

  // One-way attenuation [dB] from the aircraft at an altitude to a point at a distance over ground and a height.
  double one_way_db(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const;
  // Factors on power, in (0, 1]: for the way there and back, and for one way.
  double two_way_transmission(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const;
  double one_way_transmission(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const;

 private:
  GasProfile profile_;
};

// Two-way gas loss (factor on power) of a sweep's samples, in float. At each of 33 distances (knots) the loss is a
// parabola in the height of the ground. Between knots the coefficients of the parabola are linear in distance.
// Accuracy: 0.1 dB against GasPath for visible ground -400 to 6,000 m high (tests/model/physics/gas_test.cpp).
// Knots are recomputed only if altitude or range change.
class GasSamples {
 public:
  GasSamples(const RadarParameters& parameters, std::size_t samples);

  // Sets the samples' distances over ground, ascending, which depend on `range_m` alone. Nothing is recomputed while
  // altitude and range are unchanged.
  void use(const GasPath& path, double altitude_m, double range_m, std::span<const float> distance_m);
  // power[i] *= two-way loss for ground at height_m[i]. A NaN height counts as sea level.
  void apply(const float* height_m, float* power) const;
  // Two-way loss for ground at the height h [m MSL], one entry per sample: constant + h (slope + h bend), with h
  // clamped to [kLowest_m, kHighest_m]. The arrays have twice terrain::kRunSlack more entries.
  struct Coefficients {
    const float *constant, *slope, *bend;  // constant null: no loss
  };
  Coefficients coefficients() const { return {constant_.data(), slope_.data(), bend_.data()}; }
  static constexpr float kLowest_m = -500.0F, kHighest_m = 6000.0F;

 private:
  static constexpr std::size_t kKnots = 33;
  struct Parabola {
    double constant = 0.0, slope = 0.0, bend = 0.0;  // coefficients of 1, h and h^2, h in km
  };
  Parabola parabola_at(const GasPath& path, double altitude_m, double distance_m) const;

  GeometryParameters parameters_;
  EffectiveEarth earth_;                     // from altitude_m_
  double altitude_m_ = 0.0, range_m_ = 0.0;  // values for which knots_ were computed; range 0: none
  std::array<Parabola, kKnots> knots_{};
  memory::CacheAlignedVector<float> constant_, slope_, bend_;
};

// Rain: volume reflectivity eta at the rain rate r [mm/h], and the profile of reflectivity and attenuation
// (rain_attenuation.hpp) across a shower.
// Reflectivity factor Z = a r^b [mm^6/m^3]. Source: Marshall and Palmer 1948.
// Reflectivity eta = pi^5 |K|^2 Z / lambda^4; |K|^2: dielectric factor, lambda: wavelength. Source: Probert-Jones 1962.
// The configuration has a, b and |K|^2.
// The profile at the distance rho from the shower's centre is (1 - (rho / radius)^2)^2, a project choice. It falls
// smoothly to 0, and its integral has a closed form.

// Volume reflectivity eta [m^2/m^3] at a rain rate.
double rain_reflectivity(const radar::RainConfiguration& rain, double rate_mmh, double wavelength_m);

// Shower of the configuration.
struct Shower {
  geo::GeoPoint position;
  double radius_m = 0.0;
  double top_m = 0.0;                 // MSL
  double reflectivity = 0.0;          // [1/m] in the centre
  double attenuation_db_per_m = 0.0;  // one way, in the centre
};
std::vector<Shower> configured_showers(const RadarParameters& parameters);

// Chord of a ray through a shower, seen from above. Distances are over ground from the aircraft.
// Profile at distance d within `half_m` of the middle: (depth - ((d - middle) / radius)^2)^2, 1 in the shower's centre.
struct RainChord {
  double middle_m = 0.0;
  double half_m = 0.0;  // 0: the ray misses the shower
  double depth = 0.0;   // square root of the profile at the chord's middle; <= 0 if the ray misses the shower
  double radius_m = 0.0;

  double profile(double distance_m) const;
  // Integral of the profile between two distances.
  double integral_m(double from_m, double to_m) const;
};
// Chord of the ray from `apex` at `azimuth` through the shower with the centre `middle`.
RainChord rain_chord(geo::GeoPoint apex, geo::Bearing azimuth, geo::GeoPoint middle, double radius_m);

// Rain along one sweep: return at each range, and attenuation of other returns.
// A shower is a vertical cylinder from the ground to its top. RainChord has the profile across it.
// Return: eta times the illuminated volume R theta_az (c tau / 2) R I. R: slant range to the shower's top; theta_az:
// azimuth beamwidth; c tau / 2: pulse length. I is the integral of the two-way beam pattern over elevation, from the
// horizon (ray.hpp) to the top. With 1/R^4 the power falls as R^-2.
// Attenuation: that in each shower's centre times the profile integrated along the chord, there and back.
// The algorithm `reference` uses this class; rain_simd.hpp has the fast path of `standard`.
class RainPath {
 public:
  explicit RainPath(const RadarParameters& parameters);
  // Replaces the showers. The next call must be enter().
  void use_showers(const RadarParameters& parameters);

  // Finds the showers that a sweep crosses within its range. Call enter() once a sweep. Does not allocate.
  void enter(const SweepGeometry& geometry);
  bool dry() const { return crossed_.empty(); }

  // Factor, in (0, 1], on the power returned by a point at a distance over ground > 0: rain attenuation there and back.
  double two_way_transmission(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                              double slant_range_m) const;

  // Power [1/m^2] (unit of returned_power()) of the rain at a distance over ground, above the elevation `horizon_rad`.
  // Not attenuated by gases or rain.
  double power(const Receiver& receiver, const EffectiveEarth& earth, const SweepGeometry& geometry, double distance_m,
               double horizon_rad) const;

 private:
  struct Crossing {
    RainChord chord;
    const Shower* shower = nullptr;
  };

  radar::BeamPattern beam_;
  std::vector<Shower> showers_;
  std::vector<Crossing> crossed_;
};

// Interval of distance over ground in which a straight ray, from the aircraft at an altitude to a point at a distance
// and a height, is below the height `top_m`. Altitude and heights are above mean sea level. If there is none,
// from_m >= to_m. The ray's height is a parabola in distance (EffectiveEarth::sag_m()).
struct Stretch {
  double from_m = 0.0;
  double to_m = 0.0;
};
Stretch stretch_below(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m, double top_m);

}  // namespace yars::model::physics
