#include "display/glass_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace yars::display {

GlassView::GlassView(const radar::ViewConfiguration& view) {
  const double width = view.width_max - view.width_min;
  const double height = view.height_max - view.height_min;
  const double edge = static_cast<double>(kGlassUnits);
  const double scale = edge / std::max(width, height);
  // The shorter side is centered, so that a circle stays a circle.
  const double left = (edge - width * scale) / 2.0;
  const double bottom = edge - (edge - height * scale) / 2.0;
  apex_ = {static_cast<float>(left - view.width_min * scale), static_cast<float>(bottom + view.height_min * scale)};
  units_per_range_ = static_cast<float>(scale);
}

GlassView::GlassView(const databuffer::PatchMap& map) {
  const double edge = static_cast<double>(kGlassUnits);
  const double distance = map.distance_m / frame_of(map).range_m;
  apex_ = {kGlassUnits / 2.0F, static_cast<float>(edge / 2.0 + distance * edge)};
  units_per_range_ = kGlassUnits;
}

Point GlassView::at_polar(double right_deg, double fraction) const {
  const double angle = right_deg * geo::kRadiansPerDegree;
  const double length = fraction * static_cast<double>(units_per_range_);
  return {apex_.x + static_cast<float>(length * std::sin(angle)),
          apex_.y - static_cast<float>(length * std::cos(angle))};
}

Point GlassView::at_ground(const GlassFrame& frame, geo::GeoPoint place) const {
  const geo::GeodesicInverse line = geo::geodesic_inverse(frame.apex, place);
  return at_polar((line.azimuth_at_start - frame.up).degrees(), line.distance.metres() / frame.range_m);
}

GlassFrame frame_of(const databuffer::PatchMap& map) {
  return {{map.apex_latitude_deg, map.apex_longitude_deg},
          geo::Bearing::degrees(map.up_deg),
          map.window_nm * geo::kMetresPerNauticalMile};
}

double displacement_units(const GlassView& view, const GlassFrame& drawn, const GlassFrame& present) {
  if (drawn.range_m != present.range_m) return std::numeric_limits<double>::infinity();
  const double moved = geo::geodesic_inverse(drawn.apex, present.apex).distance.metres() / present.range_m;
  const double turned = std::abs((present.up - drawn.up).radians());
  return (moved + turned) * static_cast<double>(view.units_per_range());
}

}  // namespace yars::display
