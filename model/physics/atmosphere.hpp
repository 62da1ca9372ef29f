// Atmosphere: attenuation by gases along a ray, return and attenuation of rain.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

// What the gases of the air take from a ray: specific attenuation line by line (Recommendation ITU-R P.676-13, Annex 1,
// section 1), through the mean annual global reference atmosphere (ITU-R P.835, Annex 1): temperature in layers,
// pressure by it, water vapour falling to 1/e in each 2 km.
struct Air {
  double temperature_k = 0.0;
  double dry_hpa = 0.0;     // pressure without the water vapour's
  double water_g_m3 = 0.0;  // density of water vapour
};

// One way [dB/km].
struct GasAttenuation {
  double dry = 0.0;
  double water = 0.0;
};

// Frequency [GHz] from 1 to 1000.
GasAttenuation gas_attenuation(double frequency_ghz, const Air& air);

// At a height above mean sea level [m], up to 32 km; below the sea as at it goes on.
Air reference_air(const radar::AtmosphereConfiguration& atmosphere, double height_m);

// Attenuation by height at one frequency, looked up: straight between heights 100 m apart.
class GasProfile {
 public:
  // Nothing attenuates where the configuration switches gases off.
  GasProfile(const radar::AtmosphereConfiguration& atmosphere, double frequency_ghz);

  bool empty() const { return db_per_m_.empty(); }
  // One way; as at 30 km above that, as 1 km below the sea below that.
  double db_per_m(double height_m) const;

 private:
  std::vector<double> db_per_m_;
};

// What the gases of the air take along rays from the aircraft: the attenuation at each height, integrated over the ray.
// The ray is straight over the effective earth; its height is a parabola in the share of the way (1 m in 300 km).
class GasPath {
 public:
  explicit GasPath(const radar::RadarConfiguration& configuration);

  // True where nothing attenuates.
  bool none() const { return profile_.empty(); }

  // One way [dB] from an altitude to a point at a distance over ground and a height [m].
  double one_way_db(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const;
  // Factor on power, there and back, and one way.
  double two_way_loss(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const;
  double one_way_loss(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m) const;

 private:
  GasProfile profile_;
};

// The two-way factor for the samples of a sweep in float, as a parabola in height between distances: within 0.1 dB of
// GasPath for ground in sight from -400 to 6,000 m (tests/model/physics/gas_test.cpp). Made anew only for another
// altitude or range.
class GasSamples {
 public:
  GasSamples(const radar::RadarConfiguration& configuration, std::size_t samples);

  // Distances [m] over ground, ascending. `same`: they are those of the last call where the range is.
  void use(const GasPath& path, double altitude_m, double range_m, std::span<const float> distance_m, bool same);
  // power[i] *= the factor to ground of this height [m]; NaN: as at sea level.
  void apply(const float* height_m, float* power) const;

 private:
  static constexpr std::size_t kKnots = 33;
  struct Parabola {
    double constant = 0.0, slope = 0.0, bend = 0.0;  // of the height in km
  };
  Parabola parabola_at(const GasPath& path, double altitude_m, double distance_m) const;

  EffectiveEarth earth_;
  double altitude_m_ = 0.0, range_m_ = 0.0;  // that the knots are for; range 0: none yet
  std::array<Parabola, kKnots> knots_{};
  memory::LineVector<float> constant_, slope_, bend_;
};

// What rain returns and takes: volume reflectivity and attenuation by rate, and the profile across a shower, whose
// closed integral serves the ray. Sources: Z = a r^b, Marshall and Palmer 1948; eta = pi^5 |K|^2 Z / lambda^4, Probert-
// Jones 1962; k r^b, ITU-R P.838-3. The profile (1 - (rho/radius)^2)^2 is a project choice: a soft rim, a closed
// integral.

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

// Rain along one sweep: what it returns at each range and what it takes from everything behind it. Showers are vertical
// cylinders with a soft rim; a ray is in one as long as it is over its ground and below its top. Return: eta times the
// volume lit, R theta_az (c tau / 2) times R times the beam's integral over the elevations between the horizon and the
// top: with 1/R^4 that falls as R^-2. Loss: the chords' closed integrals, twice.
class RainPath {
 public:
  explicit RainPath(const radar::RadarConfiguration& configuration);

  // Finds the showers that a sweep crosses within its range. Once a sweep; allocates nothing.
  void enter(const SweepGeometry& look);
  bool dry() const { return crossed_.empty(); }

  // Factor on the power that comes back from a point at a distance over ground, a height and a slant range [m].
  double two_way_loss(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                      double slant_range_m) const;

  // Power [1/m^2], as returned_power(), of the rain at a distance over ground, above `horizon_rad` in elevation.
  double power(const Receiver& receiver, const EffectiveEarth& earth, const SweepGeometry& look, double distance_m,
               double horizon_rad) const;

 private:
  struct Shower {
    geo::GeoPoint place;
    double radius_m = 0.0;
    double top_m = 0.0;
    double reflectivity = 0.0;          // [1/m] in the middle
    double attenuation_db_per_m = 0.0;  // one way, in the middle
  };
  struct Crossing {
    RainChord chord;
    const Shower* shower = nullptr;
  };

  radar::BeamPattern beam_;
  std::vector<Shower> showers_;
  std::vector<Crossing> crossed_;
};

// Where a straight ray from an altitude to a point at a distance over ground lies below a height: distances over ground
// [m], from above to; empty (from >= to) where it never does. The earth falls as a parabola: within 1 m in 300 km.
struct Stretch {
  double from_m = 0.0;
  double to_m = 0.0;
};
Stretch stretch_below(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m, double top_m);

}  // namespace yars::model::physics
