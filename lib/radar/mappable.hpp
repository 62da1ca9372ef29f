// Whether the radar can make a patch map of a place, and if not, what the display says. Holds for a first map and for
// every re-map. Source: docs/spec/pilots_interface.md#rule-2, #rule-3, #rule-4, #rule-5; tables 3 and 4 of the report.
#pragma once

#include <optional>
#include <string_view>

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::radar {

// Where the aircraft is and flies; bearings true.
struct MapViewpoint {
  geo::GeoPoint aircraft;
  geo::Bearing heading;
  geo::Bearing ground_track;
};

struct MapWindow {
  geo::Length size;    // zero: by the range, while the selection is blank
  bool blank = false;  // no window was selected: a size is held by the blank selection's limits, too
};

// Nothing: mappable. Either point may not be finite: then "NO CURSOR".
std::optional<std::string_view> why_not_mappable(const MapViewpoint& from, geo::GeoPoint place, const MapWindow& window,
                                                 const RadarConfiguration& configuration);

}  // namespace yars::radar
