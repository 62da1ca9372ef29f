#include "statemachine/picture_plane.hpp"

#include <algorithm>
#include <cmath>

#include "statemachine/maps.hpp"

namespace yars::statemachine {

namespace {
constexpr radar::ViewConfiguration kMapView{-0.5, 0.5, -0.5, 0.5};  // a map fills the display; its centre is 0, 0
constexpr double kDisplayUnits = 480.0;                             // along the longer edge of the display
}  // namespace

double PicturePlane::edge() const {
  return std::max(view.width_max - view.width_min, view.height_max - view.height_min);
}

DisplayPoint PicturePlane::at_fractions(double right, double down) const {
  // The display is a square. The shorter side of the visible area is centered in it.
  const double x = (view.width_min + view.width_max) / 2.0 + (right - 0.5) * edge();
  const double y = (view.height_min + view.height_max) / 2.0 + (0.5 - down) * edge();
  return {std::clamp(x, view.width_min, view.width_max), std::clamp(y, view.height_min, view.height_max)};
}

double PicturePlane::units_between(DisplayPoint a, DisplayPoint b) const {
  return std::hypot(a.x - b.x, a.y - b.y) * kDisplayUnits / edge();
}

std::optional<PicturePlane> plane_of(const databuffer::RadarState& state, const Inputs& inputs,
                                     const radar::ViewConfiguration& view) {
  PicturePlane plane{{state.frame_latitude_deg, state.frame_longitude_deg},
                     geo::Bearing::degrees(state.frame_track_deg),
                     geo::Length::nautical_miles(state.range_nm),
                     geo::Length(),
                     view};
  if (state.map_shown == 0) return plane;
  const databuffer::PatchMap* map = map_of(inputs, state.map_shown);
  if (map == nullptr) return std::nullopt;
  plane.unit = geo::Length::nautical_miles(map->window_nm);
  plane.ahead = geo::Length::metres(map->distance_m);
  plane.view = kMapView;
  return plane;
}

}  // namespace yars::statemachine
