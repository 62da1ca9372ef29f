// Geometry of scenes. Seen from above: projection planes, polygon clipping, triangle subdivision, bounding rectangles.
// Spatial indices, which find objects near a position: discs on the earth in a grid of squares (GridIndex), and balls
// in a bounding-volume tree (SphereTree).
// Units: metres; x east, y north unless stated; degrees, as named.
// Threads: an index is immutable once built; any number of threads may search.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::model::scene {

// Linear approximation of the transform between two azimuthal equidistant planes. The origin of the second plane is the
// point `middle` of the first plane, within 20 km of the first plane's origin.
// Accuracy: to_local() within 1 mm up to 300 m from `middle`; position_of() within 10 mm in a square of 128 m about
// `middle`, below 80 degrees of latitude. Both functions take a point of the first plane.
class LocalMap {
 public:
  LocalMap(const geo::AzimuthalEquidistant& from, geo::PlanePoint middle);

  const geo::AzimuthalEquidistant& plane() const { return to_; }  // the plane about `middle`
  geo::PlanePoint to_local(geo::PlanePoint point) const {
    const double e = point.x_m - middle_.x_m, n = point.y_m - middle_.y_m;
    return {e * east_.x_m + n * north_.x_m, e * east_.y_m + n * north_.y_m};
  }
  geo::GeoPoint position_of(geo::PlanePoint point) const {
    const double e = point.x_m - middle_.x_m, n = point.y_m - middle_.y_m;
    const geo::GeoPoint o = to_.origin();
    return {o.latitude_deg + e * latitude_.x_m + n * latitude_.y_m,
            o.longitude_deg + e * longitude_.x_m + n * longitude_.y_m};
  }

 private:
  geo::PlanePoint middle_;
  geo::AzimuthalEquidistant to_;
  geo::PlanePoint east_, north_;          // one metre east, one metre north of the first plane, in the second plane
  geo::PlanePoint latitude_, longitude_;  // [deg/m] change per metre east (x) and north (y) of the first plane
};

// Convex polygon seen from above, clipped by lines along the axes (Sutherland and Hodgman 1974).
class PlanPolygon {
 public:
  using Axis = double geo::Vector3::*;

  PlanPolygon() = default;
  explicit PlanPolygon(const std::array<geo::Vector3, 3>& corners) : corners_(3) {
    std::copy(corners.begin(), corners.end(), at_.begin());
  }

  // Minimum and maximum along an axis; zeros for an empty polygon.
  std::pair<double, double> bounds(Axis axis) const {
    if (corners_ == 0) return {0.0, 0.0};
    const auto less = [axis](const geo::Vector3& a, const geo::Vector3& b) { return a.*axis < b.*axis; };
    const auto [min, max] = std::minmax_element(at_.begin(), at_.begin() + corners_, less);
    return {(*min).*axis, (*max).*axis};
  }
  // Part of the polygon with coordinates in [min, max] along an axis.
  PlanPolygon between(Axis axis, double min, double max) const {
    return beyond(axis, min, 1.0).beyond(axis, max, -1.0);
  }
  // Area seen from above [m^2]; positive for counter-clockwise corners.
  double area() const {
    double twice = 0.0;
    for (std::ptrdiff_t i = 1; i + 1 < corners_; ++i)
      twice += cross(corner(i) - corner(0), corner(i + 1) - corner(0)).z;
    return 0.5 * twice;
  }

 private:
  const geo::Vector3& corner(std::ptrdiff_t i) const { return at_[static_cast<std::size_t>(i)]; }
  // Part of the polygon with sign * (coordinate - line) >= 0. `sign` is 1 or -1.
  PlanPolygon beyond(Axis axis, double line, double sign) const {
    PlanPolygon cut;
    const auto put = [&cut](const geo::Vector3& at) { cut.at_[static_cast<std::size_t>(cut.corners_++)] = at; };
    for (std::ptrdiff_t i = 0; i < corners_; ++i) {
      const geo::Vector3 from = corner(i), to = corner(i + 1 < corners_ ? i + 1 : 0);
      const double from_m = sign * (from.*axis - line), to_m = sign * (to.*axis - line);
      if (from_m >= 0.0) put(from);
      if ((from_m >= 0.0) != (to_m >= 0.0)) put(from + (from_m / (from_m - to_m)) * (to - from));
    }
    return cut;
  }

  std::array<geo::Vector3, 16> at_{};  // four cuts of a triangle give at most seven corners; rounding adds few
  std::ptrdiff_t corners_ = 0;
};

using Corners3 = std::array<geo::Vector3, 3>;

// Edge of a triangle, with its length seen from above.
struct PlanEdge {
  std::size_t from = 0;  // number of the edge's first corner
  double length_m = 0.0;
};

// Longest edge of a triangle seen from above.
inline PlanEdge longest_plan_edge(const Corners3& corners) {
  PlanEdge longest;
  for (std::size_t i = 0; i < 3; ++i) {
    const geo::Vector3 edge = corners[(i + 1) % 3] - corners[i];
    const double length_m = std::hypot(edge.x, edge.y);
    if (length_m > longest.length_m) longest = {i, length_m};
  }
  return longest;
}

// True if surely no edge of a triangle, seen from above, is longer than `max_m`. False if one is, or may be by
// rounding. Cheaper than longest_plan_edge(), and true for most triangles of a scene.
inline bool has_no_longer_edge(const Corners3& corners, double max_m) {
  constexpr double kRounding = 1e-12;  // above that of the squares and of longest_plan_edge()
  const double max_m2 = max_m * max_m * (1.0 - kRounding);
  for (std::size_t i = 0; i < 3; ++i) {
    const geo::Vector3 edge = corners[(i + 1) % 3] - corners[i];
    if (!(edge.x * edge.x + edge.y * edge.y <= max_m2)) return false;
  }
  return true;
}

// Bisects triangles at their longest edge, seen from above, until no edge is too long. Neighbours bisect a shared edge
// at the same point, so there are no cracks.
class TriangleCutter {
 public:
  // Calls visit(piece) for each piece. No edge of a piece is longer than `max_edge_m`.
  template <class Visit>
  void cut(const Corners3& corners, double max_edge_m, const Visit& visit) {
    pieces_.assign(1, corners);
    while (!pieces_.empty()) {
      const Corners3 piece = pieces_.back();
      pieces_.pop_back();
      if (has_no_longer_edge(piece, max_edge_m)) {
        visit(piece);
        continue;
      }
      const PlanEdge edge = longest_plan_edge(piece);
      if (edge.length_m <= max_edge_m) {
        visit(piece);
        continue;
      }
      const geo::Vector3 &a = piece[edge.from], &b = piece[(edge.from + 1) % 3], &c = piece[(edge.from + 2) % 3];
      const geo::Vector3 middle = 0.5 * (a + b);
      pieces_.push_back({a, middle, c});
      pieces_.push_back({middle, b, c});
    }
  }

 private:
  std::vector<Corners3> pieces_;
};

// Rectangle of minimum area around a set of points. One of its sides lies on an edge of the points' convex hull. The
// search therefore tries every edge of the hull (Freeman and Shapira, CACM 18, 1975).
struct Footprint {
  geo::PlanePoint middle;
  double length_m = 0.0;  // longer side
  double width_m = 0.0;
  double direction_rad = 0.0;  // direction of the longer side, counter-clockwise from x, [0, pi)
};

// Returns the footprint of `points`, all zeros if there are none. Sorts `points` and removes duplicates.
Footprint footprint_of(std::vector<geo::PlanePoint>& points);

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
