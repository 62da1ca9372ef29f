// Relief of the generated landscape: broad shapes by noise, tiles of a lattice of 30 arc seconds, and a spline over the
// lattice. Erosion noise: gullies and spurs that run down the slope, as a sum of octaves from coarse to fine. Each
// octave follows the slope of the ground that includes all coarser octaves, so small gullies join larger gullies.
// Method of the noise: wave packets around scattered points, oriented by the slope (sparse convolution, Lewis 1989).
// Input: a seed, optionally an island's box; a cell. Output: heights [m MSL], negative under the sea, and slopes [m/m].
// Frame: lattice nodes are numbered from the south pole and the antimeridian. The earth is a sphere of 6371 km.
// Accuracy: all tiles and cells compute equal bits at equal positions, in any order of calls, except in the ring of
// nodes around a tile. Threads: objects are immutable after construction; one thread per GullyRow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/terrain/formats/cell.hpp"

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

using model::terrain::CellCorner;

// Box of whole cells that becomes an island. Outside the box there is only sea. A box that reaches a pole has no edge
// there. A box around the whole earth has no western and eastern edges.
struct LandscapeBox {
  int south_deg = -90;  // [-90, 89]
  int west_deg = -180;  // [-180, 179]
  int cells_north = 180;
  int cells_east = 360;

  // Distance [km] from a position inside to the nearest edge of the box, whose corners are rounded. Negative outside
  // the box; 1e6 if the box has no edge.
  double inside_km(geo::GeoPoint position) const;
};

// Broad shapes by noise on the sphere: coasts with bays, capes and islands, coastal plains, mountain ranges along the
// coasts.
class BroadRelief {
 public:
  // With a box, land ends at a coast at least 11 km inside the box's edge.
  explicit BroadRelief(std::uint32_t seed, std::optional<LandscapeBox> island = std::nullopt)
      : seed_(seed), island_(island) {}

  // Height [m MSL] without valleys, gullies and rivers; negative under the sea.
  double height_m(geo::GeoPoint position) const;

 private:
  struct Shore {
    double coast_km;  // distance inland from the coast, negative at sea
    double fade;      // [0, 1] factor on the heights of mountains and hills
  };
  Shore shore_near_edge(double coast_km, geo::GeoPoint position, geo::Vector3 warped) const;
  // Fractal noise, about [-1, 1], and ridged noise, [0, 1]. `layer`: number of the noise field; fields are independent.
  double noise(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves = 1) const;
  double ridges(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves) const;

  std::uint32_t seed_;
  std::optional<LandscapeBox> island_;
};

inline constexpr int kTileNodes = 120;           // lattice nodes per side of a tile
inline constexpr double kTileMetres = 111195.0;  // [m] one degree on a sphere of 6371 km
inline constexpr double kNodeMetres = kTileMetres / kTileNodes;

// Position of a lattice node. The row counts from the south pole; the column counts eastward from the antimeridian
// and is wrapped. Longitude [-180, 180).
geo::GeoPoint lattice_node(int row, int column);

// Length [m] of one degree of longitude, at least 1 % of the length at the equator to keep slopes at the poles finite.
double east_m_per_degree(double latitude_deg);

// The cell `north` cells north and `east` cells east of `corner`. Longitude wraps; latitude does not.
CellCorner neighbour_of(CellCorner corner, int north, int east);

// One degree of the lattice: heights of the broad shapes and the larger valleys. Node (0, 0) is the south-west corner.
// A tile owns 120 x 120 nodes. The nodes on its north and east edges belong to neighbours. There is a row of tiles
// beyond each pole, because splines at the poles use nodes beyond the poles.
class ReliefTile {
 public:
  ReliefTile(CellCorner corner, const BroadRelief& broad, const Gullies& valleys);

  CellCorner corner() const { return corner_; }
  // Height [m MSL] at a node of the tile or of the ring around it: rows and columns -1 to 120. The ring has no valleys.
  double height_m(int row, int column) const { return heights_m_[slot(row, column)]; }
  // Magnitude of the slope at a node of the tile [m/m].
  double steepness(int row, int column) const;
  geo::GeoPoint node(int row, int column) const;

 private:
  static constexpr int kSide = kTileNodes + 2;
  static std::size_t slot(int row, int column) {
    return static_cast<std::size_t>(row + 1) * kSide + static_cast<std::size_t>(column + 1);
  }

  CellCorner corner_;
  std::vector<float> heights_m_;
};

// Uniform cubic B-spline over the lattice nodes of a cell and its margin. It gives smooth heights and their slope.
// The position of a post is computed as a whole node number plus a fraction in [0, 1). So neighbouring cells compute
// equal bits on their common edge.
class LandscapeLattice {
 public:
  // `tile_at` returns the tile of a cell, also of the rows of tiles beyond the poles. `columns`: number of posts from
  // west to east.
  LandscapeLattice(CellCorner corner, int columns, const std::function<const ReliefTile&(CellCorner)>& tile_at);

  struct Ground {
    double height_m = 0.0;
    Slope slope;
  };

  // A row of posts, at the fraction `post` / `intervals` of the way from the cell's south edge to its north edge.
  class Row {
   public:
    Row(const LandscapeLattice& lattice, int post, int intervals);
    double latitude_deg() const { return latitude_deg_; }
    Ground at(int column) const;

   private:
    const LandscapeLattice* lattice_;
    double latitude_deg_;
    double east_per_node_m_;
    std::vector<double> value_m_;       // north-south spline at the row's latitude, for each lattice column
    std::vector<double> derivative_m_;  // its derivative to the north, per lattice step
  };

  // Longitude of a column of posts, [-180, 180).
  double longitude_deg(int column) const { return columns_[static_cast<std::size_t>(column)].longitude_deg; }

 private:
  static constexpr int kMargin = 2;                            // nodes beyond the cell that its spline uses
  static constexpr int kNodes = kTileNodes + 2 * kMargin + 1;  // per side

  struct Column {
    int first;  // lattice column of the first of the four nodes that the spline weights at this column of posts
    double longitude_deg;
    std::array<double, 4> value;       // weights of these nodes for the height
    std::array<double, 4> derivative;  // weights for the slope to the east, per lattice step
  };

  CellCorner corner_;
  std::vector<double> heights_m_;
  std::vector<Column> columns_;
};

}  // namespace yars::worldgen
