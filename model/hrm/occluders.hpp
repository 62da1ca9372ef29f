// Triangles that stand between the radar and what lies behind them, exact in double: the radar is the origin, rays are
// straight. A grid over the directions holds, cell by cell, every triangle that may cover one of its directions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace yars::model::hrm {

// Metres from the radar: right and ahead of the map's line of sight, and up.
struct Point3 {
  double right_m = 0.0, ahead_m = 0.0, up_m = 0.0;
};
inline Point3 operator+(Point3 a, Point3 b) {
  return {a.right_m + b.right_m, a.ahead_m + b.ahead_m, a.up_m + b.up_m};
}
inline Point3 operator-(Point3 a, Point3 b) {
  return {a.right_m - b.right_m, a.ahead_m - b.ahead_m, a.up_m - b.up_m};
}
inline Point3 operator*(double s, Point3 a) {
  return {s * a.right_m, s * a.ahead_m, s * a.up_m};
}
inline double dot(Point3 a, Point3 b) {
  return a.right_m * b.right_m + a.ahead_m * b.ahead_m + a.up_m * b.up_m;
}
inline Point3 cross(Point3 a, Point3 b) {
  return {a.ahead_m * b.up_m - a.up_m * b.ahead_m, a.up_m * b.right_m - a.right_m * b.up_m,
          a.right_m * b.ahead_m - a.ahead_m * b.right_m};
}

class Occluders {
 public:
  using Corners = std::array<Point3, 3>;

  // Triangles with a corner that is not ahead of the radar are left out.
  explicit Occluders(std::vector<Corners> triangles = {});

  // True if a triangle lies between the radar and the point, nearer than it by more than 2 cm.
  bool hide(Point3 point) const;

 private:
  struct Span {
    double least = 0.0, scale = 0.0;
    int cells = 1;
    int cell(double value) const;
  };
  void measure();
  // Calls visit(cell) for those that the triangle may cover.
  template <class Visit>
  void visit_cells(const Corners& corners, const Visit& visit) const;

  std::vector<Corners> triangles_;
  Span across_, upward_;
  std::vector<std::uint32_t> begin_;  // of each cell in entries_, and the end
  std::vector<std::uint32_t> entries_;
};

}  // namespace yars::model::hrm
