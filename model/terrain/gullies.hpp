// The look of running water without the water: stripes of spurs and gullies laid down the slope, octave upon
// octave, each following the slope that the coarser ones have made, so that small gullies join larger ones.
// A sum of directed wave packets about scattered points (sparse convolution, Lewis 1989; packets turned with the
// slope). A function of place, base height and base slope alone.
#pragma once

#include <cstdint>

namespace yars::model::terrain {

struct Slope {
  double east = 0.0;   // [m/m]
  double north = 0.0;  // [m/m]
};

class Gullies {
 public:
  explicit Gullies(std::uint32_t seed) : seed_(seed) {}

  // What to add to the base height [m], given the base's slope there. Latitude (-90, 90), any longitude [deg].
  double relief_m(double latitude_deg, double longitude_deg, Slope base) const;

 private:
  std::uint32_t seed_;
};

}  // namespace yars::model::terrain
