// Spatial indices: discs on the earth in a hash of squares, balls in a tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lib/geo/geodesy.hpp"

namespace yars::model::scene {

// Which discs on the earth come within a distance of a place, found by a hash of squares: the cost is that of what is
// near. Longitudes wrap, poles are places like others. Distances by the chord through WGS84, within 1 m up to 500 km.
// Immutable once built.
struct Disc {
  geo::GeoPoint middle;
  double reach_m = 0.0;
};

class GridIndex {
 public:
  GridIndex() = default;
  // `cell_deg`: side of a square, about the size of a usual query.
  GridIndex(const std::vector<Disc>& discs, double cell_deg);

  struct Hit {
    std::uint32_t disc = 0;   // its number
    double distance_m = 0.0;  // of its middle
    bool operator<(const Hit& other) const { return disc < other.disc; }
  };
  // Appends the discs of which any part is within the radius, in no order.
  void find(geo::GeoPoint position, double radius_m, std::vector<Hit>& hits) const;

  std::uint64_t bytes() const;

 private:
  struct Row {
    std::int64_t number = 0;
    std::int64_t columns = 1;
  };
  Row row_of(double latitude_deg) const;
  std::int64_t column_of(const Row& row, double longitude_deg) const;
  void test(std::uint32_t disc, geo::Vector3 position, double radius_m, std::vector<Hit>& hits) const;
  void find_in_row(std::int64_t number, geo::GeoPoint position, double reach_deg, geo::Vector3 at, double radius_m,
                   std::vector<Hit>& hits) const;

  double cell_deg_ = 1.0;
  double max_reach_m_ = 0.0;  // of the discs in cells
  std::vector<geo::Vector3> middles_;
  std::vector<double> reaches_m_;
  std::vector<std::uint32_t> large_;    // too large for cells: looked at every time
  std::vector<std::uint32_t> ordered_;  // discs by cell
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> cells_;  // first and end in ordered_
};

// Balls in space in an order in which neighbours lie together, with balls around ever larger runs of them: what cuts
// none of a run's ball is passed over whole, so that a search costs what it finds. Immutable once built; a search
// allocates nothing. Equal balls give equal trees.
struct Ball {
  geo::Vector3 middle;
  double radius_m = 0.0;
};

class SphereTree {
 public:
  SphereTree() = default;
  // `order` becomes the number of the ball that stands at each place of the tree's order.
  SphereTree(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order);

  // Calls visit(first, end) with runs of that order of which meets(ball) is true for the ball around them, ascending.
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
    float x_m, y_m, z_m, radius_m;
    std::uint32_t first, end;  // in the order
    std::uint32_t skip_to;     // the node after all that are below this one
  };
  void build(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t end);

  std::vector<Node> nodes_;  // each before those below it
};

}  // namespace yars::model::scene
