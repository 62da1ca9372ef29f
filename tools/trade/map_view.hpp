// What a trade of maps looks at: from where, to where, how wide a window.
#pragma once

#include <string>
#include <string_view>

#include "lib/failure/error.hpp"
#include "lib/geo/geodesic.hpp"
#include "model/hrm/patch_geometry.hpp"

namespace yars::tools::trade {

struct MapView {
  geo::GeoPoint place;
  double altitude_ft = 15000.0;
  geo::GeoPoint target;
  double window_nm = 3.3;
};

// From "LAT,LON,ALT_FT,TARGET_LAT,TARGET_LON,WINDOW_NM". Errors: not six numbers, one out of its range, a target that
// is not farther away than the window is wide.
failure::Expected<MapView> map_view_of(std::string_view text);

// "37.8 -122.3 3.3 NM from 20 NM, 15000 ft".
std::string map_view_name(const MapView& view);

// A target to be seen from a distance [NM] and a bearing: the aircraft goes where that is.
MapView view_of_target(geo::GeoPoint target, double distance_nm, double bearing_deg, double altitude_ft,
                       double window_nm);

// One map of it, by one look, the ground track square to the line of sight so that nothing is blind.
model::hrm::PatchOrder order_of(const MapView& view);

}  // namespace yars::tools::trade
