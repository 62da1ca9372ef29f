// Rain along one sweep: what it returns at each range and what it takes from everything behind it. Showers are vertical
// cylinders with a soft rim; a ray is in one as long as it is over its ground and below its top. Return: eta times the
// volume lit, R theta_az (c tau / 2) times R times the beam's integral over the elevations between the horizon and the
// top: with 1/R^4 that falls as R^-2. Loss: the chords' closed integrals, twice.
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/rbm/earth.hpp"
#include "model/rbm/look.hpp"
#include "model/rbm/receiver.hpp"
#include "model/reflectivity/rain.hpp"

namespace yars::model::rbm {

class RainPath {
 public:
  explicit RainPath(const radar::RadarConfiguration& configuration);

  // Finds the showers that a sweep crosses within its range. Once a sweep; allocates nothing.
  void enter(const Look& look);
  bool dry() const { return crossed_.empty(); }

  // Factor on the power that comes back from a point at a distance over ground, a height and a slant range [m].
  double two_way_loss(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                      double slant_range_m) const;

  // Power [1/m^2], as returned_power(), of the rain at a distance over ground, above `horizon_rad` in elevation.
  double power(const Receiver& receiver, const EffectiveEarth& earth, const Look& look, double distance_m,
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
    reflectivity::RainChord chord;
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

}  // namespace yars::model::rbm
