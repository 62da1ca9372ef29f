#include "display/wedge.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"

namespace yars::display {

namespace {

// Turns east and north metres of the frame's apex into units on the glass.
class GroundPlan {
 public:
  GroundPlan(const GlassView& view, const GlassFrame& frame)
      : tangent_(frame.apex, geo::HeightAboveEllipsoid::metres(0.0)),
        apex_(view.apex()),
        units_per_metre_(static_cast<double>(view.units_per_range()) / frame.range_m),
        sine_(std::sin(frame.up.radians())),
        cosine_(std::cos(frame.up.radians())) {}

  Point at(geo::Vector3 ecef) const {
    const geo::Vector3 enu = tangent_.enu_from_ecef(ecef);
    const double right_m = enu.x * cosine_ - enu.y * sine_;
    const double up_m = enu.x * sine_ + enu.y * cosine_;
    return {apex_.x + static_cast<float>(right_m * units_per_metre_),
            apex_.y - static_cast<float>(up_m * units_per_metre_)};
  }

  Point direction(geo::Vector3 from_ecef, geo::Vector3 to_ecef) const {
    const geo::Vector3 from = tangent_.enu_from_ecef(from_ecef);
    const geo::Vector3 to = tangent_.enu_from_ecef(to_ecef);
    const double east = to.x - from.x;
    const double north = to.y - from.y;
    const double length = std::hypot(east, north);
    return {static_cast<float>((east * cosine_ - north * sine_) / length),
            static_cast<float>(-(east * sine_ + north * cosine_) / length)};
  }

  double units_per_metre() const { return units_per_metre_; }

 private:
  geo::LocalTangentFrame tangent_;
  Point apex_;
  double units_per_metre_;
  double sine_, cosine_;
};

}  // namespace

void place_wedges(const PolarStore& store, const GlassView& view, const GlassFrame& frame, std::vector<Wedge>& wedges) {
  const GroundPlan plan(view, frame);
  wedges.clear();
  for (const StoredSweep& sweep : store.by_azimuth()) {
    wedges.push_back({plan.at(sweep.apex_ecef), plan.direction(sweep.apex_ecef, sweep.left_ecef),
                      plan.direction(sweep.apex_ecef, sweep.right_ecef),
                      static_cast<float>(sweep.range_m * plan.units_per_metre()),
                      static_cast<float>(sweep.half_width_rad), sweep.row, sweep.samples, sweep.serial});
  }
  std::sort(wedges.begin(), wedges.end(), [](const Wedge& a, const Wedge& b) { return a.serial < b.serial; });
}

}  // namespace yars::display
