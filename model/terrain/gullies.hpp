// The look of running water without the water: stripes of spurs and gullies laid down the slope, octave upon
// octave, each following the slope that the coarser ones have made, so that small gullies join larger ones.
// A sum of directed wave packets about scattered points (sparse convolution, Lewis 1989; packets turned with the
// slope). A function of place, base height and base slope alone.
#pragma once

#include <cstdint>
#include <span>

namespace yars::model::terrain {

struct Slope {
  double east = 0.0;   // [m/m]
  double north = 0.0;  // [m/m]
};

struct GullyOctave {
  double wavelength_m;  // from gully to gully
  double depth;         // [m] of relief to either side, per metre of wavelength and unit of slope
};

class Gullies {
 public:
  // `octaves` from coarse to fine; they outlive the object.
  Gullies(std::uint32_t seed, std::span<const GullyOctave> octaves) : seed_(seed), octaves_(octaves) {}

  // What to add to the base height [m], given the base's slope there. Latitude (-90, 90), longitude [-180, 180) deg.
  double relief_m(double latitude_deg, double longitude_deg, Slope base) const;

 private:
  std::uint32_t seed_;
  std::span<const GullyOctave> octaves_;
};

}  // namespace yars::model::terrain
