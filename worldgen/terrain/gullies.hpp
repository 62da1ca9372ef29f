// The look of running water without the water: stripes of spurs and gullies laid down the slope, octave upon
// octave, each following the slope that the coarser ones have made, so that small gullies join larger ones.
// A sum of directed wave packets about scattered points (sparse convolution, Lewis 1989; packets turned with the
// slope). A function of place, base height and base slope alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace yars::worldgen {

struct Slope {
  double east = 0.0;   // [m/m]
  double north = 0.0;  // [m/m]
};

struct GullyOctave {
  double wavelength_m;  // from gully to gully
  double depth;         // [m] of relief to either side, per metre of wavelength and unit of slope
};

// `octaves` from coarse to fine; they outlive the object.
struct Gullies {
  std::uint32_t seed;
  std::span<const GullyOctave> octaves;
};

// Gullies along one parallel: what depends on latitude is worked out once, scattered points are kept while places
// stay near them. Whatever the order of places, a place gives the same bits.
class GullyRow {
 public:
  // Latitude [-90, 90] deg.
  GullyRow(const Gullies& gullies, double latitude_deg);

  struct Relief {
    double height_m = 0.0;  // what to add to the base height
    Slope slope;            // of the ground with its gullies
  };
  // Longitude [-180, 180) deg; `base` is the slope of the ground without gullies.
  Relief at(double longitude_deg, Slope base);

 private:
  struct Wave {
    double cosine = 0.0;  // +1 on a spur, -1 in a gully
    double sine = 0.0;
  };
  // Scattered points lie one to a square, in rows along parallels; a row has as many squares as fit round it, so
  // that they are evenly spaced at every latitude.
  struct Band {
    std::int32_t index = 0;  // of the row
    double north = 0.0;      // of the places, from the row's south edge, in rows
    double columns = 1.0;    // round the earth
    double width = 1.0;      // of a square at the places' latitude, in rows
    double middle = -1e9;    // column whose neighbourhood `points` holds
    struct Point {
      double column;  // of the point, from the antimeridian
      double north;   // of the places above the point, in rows
    };
    std::array<Point, 3> points{};
  };
  struct Octave {
    GullyOctave shape;
    std::uint32_t seed = 0;
    std::array<Band, 3> bands;
  };
  static void gather(Band& band, double middle, std::uint32_t seed);
  static Wave packets(Octave& octave, double turn, Slope across);

  std::vector<Octave> octaves_;
};

}  // namespace yars::worldgen
