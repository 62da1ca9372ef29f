// What the gases of the air take along rays from the aircraft: the attenuation at each height, integrated over the ray.
// The ray is straight over the effective earth; its height is a parabola in the share of the way (1 m in 300 km).
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/rbm/earth.hpp"
#include "model/reflectivity/gases.hpp"

namespace yars::model::rbm {

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
  reflectivity::GasProfile profile_;
};

// The two-way factor for the samples of a sweep in float, as a parabola in height between distances: within 0.1 dB of
// GasPath for ground in sight from -400 to 6,000 m (tests/model/gas_test.cpp). Made anew only for another altitude or
// range.
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

}  // namespace yars::model::rbm
