// Projection of the present picture, between the ground and the display.
// Inputs: frame (apex and up direction) of the picture, selected range, record of the shown map, limits of the display.
// Outputs: positions on the display, in multiples of PicturePlane::unit; ground positions (WGS84).
// Errors: no projection of a map without a record.
// Source: docs/pilots_manual.md#view.
#pragma once

#include <optional>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/view.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Position on the display: x right, y up. PicturePlane defines the origin and the unit.
struct DisplayPoint {
  double x = 0.0;
  double y = 0.0;
};

// Projection of the display: geodesic distance and azimuth from an apex, plotted on a plane (azimuthal equidistant).
struct PicturePlane {
  geo::GeoPoint apex;  // below the aircraft: now; for a frozen picture or a map, when it was frozen or begun
  geo::Bearing up;     // direction at the apex that is upward on the display
  geo::Length unit;    // ground distance of 1 on the display: the selected range, or the window of the map
  geo::Length ahead;   // distance of the origin from the apex, upward
  // Limits of the display, in multiples of `unit`.
  radar::ViewConfiguration view;

  DisplayPoint display_from_ground(geo::GeoPoint position) const {
    const geo::PlanePoint point = geo::AzimuthalEquidistant(apex, up).plane_from_geodetic(position);
    return {geo::Length::metres(point.x_m) / unit, (geo::Length::metres(point.y_m) - ahead) / unit};
  }
  geo::GeoPoint ground_from_display(DisplayPoint point) const {
    return geo::AzimuthalEquidistant(apex, up).geodetic_from_plane(
        {(point.x * unit).metres(), (point.y * unit + ahead).metres()});
  }
  bool shows(DisplayPoint point) const {
    return point.x >= view.width_min && point.x <= view.width_max && point.y >= view.height_min &&
           point.y <= view.height_max;
  }
  // Position at fractions [0, 1] of the square display, from its upper left corner, limited to the visible area.
  DisplayPoint at_fractions(double right, double down) const;
  // Distance between two positions on the display, in display units. A display unit is 1/480 of the display's longer
  // edge. It is not PicturePlane::unit.
  double units_between(DisplayPoint a, DisplayPoint b) const;
  double edge() const;  // length of the display's edge, in multiples of `unit`
};

// Projection of the present picture. nullopt: the shown map has no record, so its position is unknown.
std::optional<PicturePlane> plane_of(const databuffer::RadarState& state, const Inputs& inputs,
                                     const radar::ViewConfiguration& view);

}  // namespace yars::statemachine
