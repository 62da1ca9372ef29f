// Rain along the samples of a sweep, in Highway vectors of float: the fast path of RainPath (atmosphere.hpp).
// Inputs: sweep geometry; distance, ground elevation and horizon of each sample; configured showers.
// Outputs: power returned by rain (full scale = 1) and the factor of its attenuation on power, per sample.
// Accuracy against RainPath, for rain down to 1e-4 of full scale: 0.02 dB of power; 0.02 dB or 0.1 % of the
//   attenuation in dB, whichever is more. Chords are within 10 m of rain_chord() for rays up to 320 NM.
// Threads: one thread at a time may use an instance. No allocation after construction. Results are equal bit by bit on
//   every target (instruction set).
// Source: docs/spec/physics.md#rain.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

namespace simd {

// Chord of the ray through a shower (RainChord), and the shower.
struct RainCrossing {
  float middle_m = 0.0F, half_m = 0.0F, depth = 0.0F;
  float radius_inverse = 0.0F;  // [1/m]
  float top_m = 0.0F;           // MSL
  float reflectivity = 0.0F;    // in the centre, times the constants of the radar equation [m^2]
  float octaves_per_m = 0.0F;   // two-way attenuation in the centre: log2 of the factor on power
};

struct RainConstants {
  float altitude_m = 0.0F;   // [m MSL] of the aircraft
  float curvature = 0.0F;    // [1/m] EffectiveEarth::curvature()
  Lift lift;                 // by refraction
  float half_stc = 0.0F;     // half the exponent of the sensitivity time control
  float stc_octaves = 0.0F;  // exponent times log2 of kFullScaleRange [m]
  // Beam: elevation of the antenna, half of the elevation beamwidth, and values of beam_integral().
  float sin_elevation = 0.0F, cos_elevation = 1.0F;
  float half_beam_rad = 0.0F;
  float erf_per_rad = 0.0F;   // argument of erf() per angle off the axis
  float gaussian_rad = 0.0F;  // integral of the Gaussian pattern from the axis outwards
  float sin_centre2 = 0.0F;   // squared sine of the depression of the cosecant pattern's centre
  float centre_cotangent = 0.0F;
  float sin_axis = 0.0F, cos_axis = 1.0F;  // of the sum of that depression and the antenna's elevation
};

// Ground of a sweep: one entry per sample. After the last one terrain::kRunSlack more entries are read.
struct RainGround {
  const float* distance_m;   // over ground, ascending
  const float* elevation_m;  // [m MSL] NaN: void, counts as sea level
  const float* horizon;      // maximum tangent of the ground up to and including the sample
};

}  // namespace simd

class RainSamples {
 public:
  RainSamples(const RadarParameters& parameters, std::size_t samples);
  // Replaces the showers. The next call must be enter().
  void use_showers(const RadarParameters& parameters);

  // Finds the showers that a sweep crosses within its range. Call enter() once a sweep.
  void enter(const SweepGeometry& geometry);
  bool dry() const { return crossed_.empty(); }

  // Computes power() and transmission() of the samples. Gases do not attenuate power().
  void measure(const SweepGeometry& geometry, const EffectiveEarth& earth, const Receiver& receiver,
               const simd::RainGround& ground);
  float* power() { return power_.data(); }                            // full scale = 1
  const float* transmission() const { return transmission_.data(); }  // (0, 1]

 private:
  simd::RainConstants constants(const SweepGeometry& geometry, const EffectiveEarth& earth,
                                const Receiver& receiver) const;

  radar::BeamPattern beam_;
  std::vector<Shower> showers_;
  std::vector<geo::Vector3> centres_;  // [m] ECEF, on the ellipsoid
  struct Crossed {
    RainChord chord;
    const Shower* shower;
  };
  std::vector<Crossed> crossed_;
  std::vector<simd::RainCrossing> crossings_;
  std::size_t samples_;
  memory::CacheAlignedVector<float> power_, transmission_;
};

// Chord of a ray through a shower from the position of the shower's centre, relative to the apex: `ahead_m` along the
// ray and `right_m` across, in the apex's horizontal plane. `radius_of_curvature_m`: of the ellipsoid, along the ray.
// Series in the angle at the earth's centre, as far as 1,000 NM. Accuracy: 10 m against rain_chord() up to 320 NM.
RainChord rain_chord_in_plane(double ahead_m, double right_m, double radius_of_curvature_m, double radius_m);

}  // namespace yars::model::physics
