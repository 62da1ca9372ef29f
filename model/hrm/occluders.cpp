#include "model/hrm/occluders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace yars::model::hrm {

namespace {
constexpr double kClear_m = 0.02;  // [m] a triangle this close in front of a point counts as the point's own surface
constexpr int kMaxCells = 2048;    // per side of the grid

// True if the ray from the radar through the point meets the triangle. The intersection is at `fraction` of the point's
// distance. Source: Moeller, Trumbore (1997).
bool meets(const Occluders::Corners& corners, Point3 point, double& fraction) {
  const Point3 first_edge = corners[1] - corners[0];
  const Point3 second_edge = corners[2] - corners[0];
  const Point3 normal = cross(point, second_edge);
  const double determinant = dot(first_edge, normal);
  if (determinant == 0.0) return false;
  const Point3 from = -1.0 * corners[0];
  const double u = dot(from, normal) / determinant;
  if (u < 0.0 || u > 1.0) return false;
  const Point3 turned = cross(from, first_edge);
  const double v = dot(point, turned) / determinant;
  if (v < 0.0 || u + v > 1.0) return false;
  fraction = dot(second_edge, turned) / determinant;
  return fraction > 0.0;
}
}  // namespace

int Occluders::Span::cell(double value) const {
  return std::clamp(static_cast<int>((value - low) * scale), 0, cells - 1);
}

Occluders::Occluders(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  const auto too_near = [](const Corners& corners) {
    return std::any_of(corners.begin(), corners.end(), [](Point3 corner) { return !(corner.y > 1.0); });
  };
  triangles_.erase(std::remove_if(triangles_.begin(), triangles_.end(), too_near), triangles_.end());
  if (triangles_.empty()) return;
  measure();
  begin_.assign(static_cast<std::size_t>(across_.cells) * static_cast<std::size_t>(upward_.cells) + 1, 0);
  for (const Corners& corners : triangles_) visit_cells(corners, [&](std::size_t cell) { ++begin_[cell + 1]; });
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  entries_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    visit_cells(triangles_[t], [&](std::size_t cell) { entries_[next[cell]++] = static_cast<std::uint32_t>(t); });
}

void Occluders::measure() {
  double low[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double high[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  for (const Corners& corners : triangles_) {
    for (const Point3& corner : corners) {
      const double at[2] = {corner.x / corner.y, corner.z / corner.y};
      for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], at[axis]);
        high[axis] = std::max(high[axis], at[axis]);
      }
    }
  }
  // About four cells per triangle. Seen from the radar a scene is wide, so the grid has twice as many columns as rows.
  const double cells = std::sqrt(static_cast<double>(triangles_.size()) * 2.0);
  const auto span = [&](int axis, double aspect) {
    Span axis_span;
    axis_span.low = low[axis];
    axis_span.cells = std::clamp(static_cast<int>(aspect * cells), 1, kMaxCells);
    axis_span.scale = high[axis] > low[axis] ? axis_span.cells / (high[axis] - low[axis]) : 0.0;
    return axis_span;
  };
  across_ = span(0, 2.0);
  upward_ = span(1, 1.0);
}

template <class Visit>
void Occluders::visit_cells(const Corners& corners, const Visit& visit) const {
  int low[2] = {across_.cells, upward_.cells};
  int high[2] = {-1, -1};
  for (const Point3& corner : corners) {
    const int at[2] = {across_.cell(corner.x / corner.y), upward_.cell(corner.z / corner.y)};
    for (int axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], at[axis]);
      high[axis] = std::max(high[axis], at[axis]);
    }
  }
  for (int row = low[1]; row <= high[1]; ++row)
    for (int column = low[0]; column <= high[0]; ++column)
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(across_.cells) + static_cast<std::size_t>(column));
}

bool Occluders::hide(Point3 point) const {
  if (triangles_.empty() || !(point.y > 0.0)) return false;
  const auto row = static_cast<std::size_t>(upward_.cell(point.z / point.y));
  const auto column = static_cast<std::size_t>(across_.cell(point.x / point.y));
  const std::size_t cell = row * static_cast<std::size_t>(across_.cells) + column;
  const double length_m = std::sqrt(dot(point, point));
  for (std::uint32_t entry = begin_[cell]; entry < begin_[cell + 1]; ++entry) {
    double fraction = 0.0;
    if (meets(triangles_[entries_[entry]], point, fraction) && (1.0 - fraction) * length_m > kClear_m) return true;
  }
  return false;
}

}  // namespace yars::model::hrm
