// Spatial indices, which find objects near a position: discs on the earth in a grid of squares (GridIndex), and balls
// in a bounding-volume tree (SphereTree). Units: metres and degrees, as named.
// Threads: immutable once built; any number of threads may search.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"

namespace yars::model::scene {

// Circle on the earth that contains an indexed object.
struct Disc {
  geo::GeoPoint middle;
  double radius_m = 0.0;
};

// Finds the discs that overlap a circle about a position. The grid divides the earth into rows of squares (cells). A
// search tests the discs in nearby cells, and all discs with a radius above two cell sides. A wide search tests every
// disc. Longitudes wrap, and callers need no special case at poles. Distances are computed from the chord through the
// WGS84 ellipsoid. Their error is below 2 m up to 500 km.
class GridIndex {
 public:
  GridIndex() = default;
  // `cell_deg`: side of a cell [deg], about the diameter of a typical search.
  GridIndex(const std::vector<Disc>& discs, double cell_deg);

  struct Hit {
    std::uint32_t disc = 0;   // number of the disc
    double distance_m = 0.0;  // from the position to the disc's centre
    bool operator<(const Hit& other) const { return disc < other.disc; }
  };
  // Appends the discs that overlap the circle about `position`, in no particular order.
  void find(geo::GeoPoint position, double radius_m, std::vector<Hit>& hits) const;

  std::uint64_t bytes() const;

 private:
  struct Row {
    std::int64_t number = 0;   // from the south pole
    std::int64_t columns = 1;  // number of cells around the earth
  };
  Row row_of(double latitude_deg) const;
  std::int64_t column_of(const Row& row, double longitude_deg) const;
  void test(std::uint32_t disc, geo::Vector3 position, double radius_m, std::vector<Hit>& hits) const;
  void find_in_row(std::int64_t number, geo::GeoPoint position, double half_deg, geo::Vector3 at, double radius_m,
                   std::vector<Hit>& hits) const;

  double cell_deg_ = 1.0;
  double max_radius_m_ = 0.0;  // largest radius of the discs that are in cells
  std::vector<geo::Vector3> middles_;
  std::vector<double> radii_m_;
  std::vector<std::uint32_t> large_;    // discs too large for cells: tested in every search
  std::vector<std::uint32_t> ordered_;  // numbers of the discs, sorted by cell
  // By row and column of a cell: its discs as [first, end) in ordered_.
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> cells_;
};

struct Ball {
  geo::Vector3 middle;
  double radius_m = 0.0;
};

// Binary tree of bounding balls over the given balls, which the tree orders by position. A search skips every subtree
// for which meets(bounding ball) is false, and allocates nothing. Equal inputs give equal trees.
class SphereTree {
 public:
  SphereTree() = default;
  // Sets order[i] to the number of the ball that is at index i in the tree's order.
  SphereTree(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order);

  // A leaf is a run of consecutive balls in the tree's order, from `first` to before `end`. Calls visit(first, end) for
  // a leaf if meets(bounding ball) is true for the leaf and for all nodes above it. The visits follow the tree's order.
  template <class Meets, class Visit>
  void search(const Meets& meets, const Visit& visit) const {
    for (std::size_t at = 0; at < nodes_.size();) {
      const Node& node = nodes_[at];
      const bool met =
          meets(Ball{{static_cast<double>(node.x_m), static_cast<double>(node.y_m), static_cast<double>(node.z_m)},
                     static_cast<double>(node.radius_m)});
      const bool leaf = node.skip_to == at + 1;
      if (met && leaf) visit(node.first, node.end);
      at = met ? at + 1 : node.skip_to;
    }
  }

  std::uint64_t bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  struct Node {
    float x_m, y_m, z_m, radius_m;  // bounding ball
    std::uint32_t first, end;       // balls of the subtree: indices in the tree's order
    std::uint32_t skip_to;          // index of the node after this subtree
  };
  void build(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t end);

  std::vector<Node> nodes_;  // each node precedes its subtree
};

}  // namespace yars::model::scene
