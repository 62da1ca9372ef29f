// Where and how far a trade looks: one place, altitude, heading and range scale.
#pragma once

#include <string>
#include <string_view>

#include "lib/failure/error.hpp"
#include "lib/geo/geodesic.hpp"
#include "model/kernel/offline_scan.hpp"

namespace yars::tools::trade {

struct Scene {
  geo::GeoPoint place;
  double altitude_ft = 15000.0;
  double heading_deg = 60.0;
  double range_nm = 40.0;
};

// From "LAT,LON,ALT_FT,HDG,RANGE_NM". Errors: not five numbers, or one out of its range.
failure::Expected<Scene> scene_of(std::string_view text);

// "37 -122 15000 ft 60 deg 40 NM".
std::string scene_name(const Scene& scene);

// One scan of it. The antenna looks at sea level at the far end of the range, as cosecant-squared wants it.
model::kernel::ScanRequest request_of(const Scene& scene, geo::Angle width);

}  // namespace yars::tools::trade
