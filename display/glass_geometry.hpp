// Where ground lies on the glass. The view is a plan of the radar's surroundings in fractions of the selected
// range (RadarConfiguration::view), fitted into the square with equal scales; by default the apex is 40 units up
// in the middle and the range is 400 units.
// Ground: geodesic distance and bearing from the frame's apex, the ground track upwards (azimuthal equidistant).
// A patch map fills the square with its window: the same plan about the map's own apex, its line of sight upwards.
#pragma once

#include "databuffer/records/patch_map.hpp"
#include "display/point.hpp"
#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display {

// The picture's place on the earth.
struct GlassFrame {
  geo::GeoPoint apex;
  geo::Bearing up;       // true bearing that points up: the ground track, or a map's line of sight
  double range_m = 0.0;  // [m] selected range, or a map's window
};

class GlassView {
 public:
  explicit GlassView(const radar::ViewConfiguration& view);
  explicit GlassView(const databuffer::PatchMap& map);  // far below the glass lies the apex

  Point apex() const { return apex_; }
  float units_per_range() const { return units_per_range_; }  // [units] length of the selected range

  // `right_deg`: clockwise from up [deg]; `fraction` of the selected range.
  Point at_polar(double right_deg, double fraction) const;
  Point at_ground(const GlassFrame& frame, geo::GeoPoint place) const;

 private:
  Point apex_;
  float units_per_range_ = 0.0F;
};

GlassFrame frame_of(const databuffer::PatchMap& map);

// How far a picture drawn in `drawn` is off at its outer edge when `present` is the truth [units].
double displacement_units(const GlassView& view, const GlassFrame& drawn, const GlassFrame& present);

}  // namespace yars::display
