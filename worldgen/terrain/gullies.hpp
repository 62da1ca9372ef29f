// Erosion noise: gullies and spurs that run down the slope, as a sum of octaves from coarse to fine.
// Each octave follows the slope of the ground that includes all coarser octaves, so small gullies join larger gullies.
// Method: wave packets around scattered points, oriented by the slope (sparse convolution, Lewis 1989).
// Input: position, and slope [m/m] of the ground without gullies. Output: height to add [m] and the slope with gullies.
// Accuracy: a position gives the same bits in any order of calls. Threads: one thread per GullyRow.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace yars::worldgen {

struct Slope {
  double east = 0.0;   // [m/m] positive: the ground rises to the east
  double north = 0.0;  // [m/m] positive: the ground rises to the north
};

struct GullyOctave {
  double wavelength_m;  // distance between gullies
  // Amplitude / (wavelength * slope) on medium slopes. On slopes below 0.02 or above 0.45 this ratio becomes smaller.
  double depth;
};

// Parameters of the noise. `octaves` are sorted from coarse to fine and must outlive the object.
struct Gullies {
  std::uint32_t seed;
  std::span<const GullyOctave> octaves;
};

// Gullies along one parallel. The constructor computes values that depend on latitude only. at() caches scattered
// points.
class GullyRow {
 public:
  // Latitude [-90, 90] deg.
  GullyRow(const Gullies& gullies, double latitude_deg);

  struct Relief {
    double height_m = 0.0;  // height to add to the ground; negative in gullies
    Slope slope;            // slope of the ground with gullies
  };
  // Longitude [-180, 180) deg; `base` is the slope of the ground without gullies.
  Relief at(double longitude_deg, Slope base);

 private:
  struct Wave {
    double cosine = 0.0;  // +1 on a spur, -1 in a gully
    double sine = 0.0;    // at the same phase
  };
  // A row of squares along a parallel, each with one scattered point. The number of squares in a row depends on its
  // latitude, so that the density of points is about the same everywhere. The unit [rows] is the height of a row, one
  // wavelength of the octave.
  struct Band {
    std::int32_t index = 0;  // number of the row
    double north = 0.0;      // [rows] distance of this GullyRow's parallel north of the row's south edge
    double columns = 1.0;    // squares around the earth
    double width = 1.0;      // [rows] width of a square at the parallel
    double middle = -1e9;    // column of the middle point of `points`
    struct Point {
      double column;  // [columns] position of the point east of the antimeridian
      double north;   // [rows] distance of this GullyRow's parallel north of the point
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
