#include "tools/trade/map_view.hpp"

#include <array>

#include "tools/trade/fields.hpp"

namespace yars::tools::trade {

namespace {

constexpr std::array<Bounds, 6> kViewBounds{{{"latitude [deg]", -90.0, 90.0},
                                         {"longitude [deg]", -180.0, 180.0},
                                         {"altitude [ft]", -3000.0, 600000.0},
                                         {"target's latitude [deg]", -90.0, 90.0},
                                         {"target's longitude [deg]", -180.0, 180.0},
                                         {"window [NM]", 0.01, 200.0}}};

double distance_nm(const MapView& view) {
  return geo::geodesic_inverse(view.place, view.target).distance.nautical_miles();
}

}  // namespace

failure::Expected<MapView> map_view_of(std::string_view text) {
  const auto values = numbers_of(text, kViewBounds, "--view", "LAT,LON,ALT_FT,TARGET_LAT,TARGET_LON,WINDOW_NM");
  if (!values) return tl::unexpected(values.error());
  const MapView view{{(*values)[0], (*values)[1]}, (*values)[2], {(*values)[3], (*values)[4]}, (*values)[5]};
  if (distance_nm(view) <= view.window_nm)
    return tl::unexpected<failure::Error>(failure::Error{"--view", "a target farther away than the window is wide",
                                                         short_number(distance_nm(view)) + " NM", "", true});
  return view;
}

std::string map_view_name(const MapView& view) {
  return short_number(view.target.latitude_deg) + " " + short_number(view.target.longitude_deg) + " " +
         short_number(view.window_nm) + " NM from " + short_number(distance_nm(view)) + " NM, " +
         short_number(view.altitude_ft) + " ft";
}

MapView view_of_target(geo::GeoPoint target, double distance_nm, double bearing_deg, double altitude_ft,
                       double window_nm) {
  return {geo::geodesic_direct(target, geo::Bearing::degrees(bearing_deg), geo::Length::nautical_miles(distance_nm)),
          altitude_ft, target, window_nm};
}

model::hrm::PatchOrder order_of(const MapView& view) {
  model::hrm::PatchOrder order;
  order.apex = view.place;
  order.altitude = geo::AltitudeMsl::feet(view.altitude_ft);
  order.centre = view.target;
  order.ground_track = geo::geodesic_inverse(view.place, view.target).azimuth_at_start - geo::Angle::degrees(90.0);
  order.ground_speed = geo::Speed::knots(480.0);
  order.window = geo::Length::nautical_miles(view.window_nm);
  order.looks = 1;
  return order;
}

}  // namespace yars::tools::trade
