// What a trade looks at, scans and maps, and the columns of its table for each.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/kernel/offline_scan.hpp"
#include "tools/trade/map_errors.hpp"
#include "tools/trade/scan_errors.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

// Where and how far a trade looks: one place, altitude, heading and range scale.
struct Scene {
  geo::GeoPoint place;
  double altitude_ft = 15000.0;
  double heading_deg = 60.0;
  double range_nm = 40.0;
};

// From "LAT,LON,ALT_FT,HDG,RANGE_NM". Errors: not five numbers, or one out of its range.
error::Expected<Scene> scene_of(std::string_view text);

// "37 -122 15000 ft 60 deg 40 NM".
std::string scene_name(const Scene& scene);

// One scan of it. The antenna looks at sea level at the far end of the range, as cosecant-squared wants it.
model::kernel::ScanRequest request_of(const Scene& scene, geo::Angle width);

// What a trade of maps looks at: from where, to where, how wide a window.
struct MapView {
  geo::GeoPoint place;
  double altitude_ft = 15000.0;
  geo::GeoPoint target;
  double window_nm = 3.3;
};

// From "LAT,LON,ALT_FT,TARGET_LAT,TARGET_LON,WINDOW_NM". Errors: not six numbers, one out of its range, a target that
// is not farther away than the window is wide.
error::Expected<MapView> map_view_of(std::string_view text);

// "37.8 -122.3 3.3 NM from 20 NM, 15000 ft".
std::string map_view_name(const MapView& view);

// A target to be seen from a distance [NM] and a bearing: the aircraft goes where that is.
MapView view_of_target(geo::GeoPoint target, double distance_nm, double bearing_deg, double altitude_ft,
                       double window_nm);

// One map of it, by one look, the ground track square to the line of sight so that nothing is blind.
model::hrm::PatchOrder order_of(const MapView& view);

// What the table of a trade of scans holds.
enum ScanColumn : std::size_t {
  kScanMs,
  kSamplesPerSecond,
  kScanTerrainBytes,
  kScanPosition,
  kScanShadow,
  kScanPower,
  kScanGray
};
inline constexpr std::array<Column, 7> kScanColumns{{{"scan_ms", "ms a scan"},
                                                     {"samples_per_second", "M samples/s", 1e-6, true},
                                                     {"terrain_bytes", "terrain MB", 1e-6},
                                                     {"position_m", "position m"},
                                                     {"shadow_percent", "shadow %"},
                                                     {"power_db", "power dB"},
                                                     {"gray_levels", "gray"}}};
inline constexpr std::array<std::string_view, 5> kScanFields{"latitude_deg", "longitude_deg", "altitude_ft",
                                                             "heading_deg", "range_nm"};

struct Cost {
  double scan_ms = 0.0;  // [ms] of the thread's processor time
  double samples_per_second = 0.0;
  double terrain_bytes = 0.0;  // resident
};

Values values_of(const Cost& cost, const Errors& errors);
SceneRow row_of(const Scene& scene);

// What the table of a trade of maps holds.
enum MapColumn : std::size_t { kMapMs, kMapTerrainBytes, kMapPosition, kMapShadow, kMapPower, kMapGray };
inline constexpr std::array<Column, 6> kMapColumns{{{"map_ms", "ms a map"},
                                                    {"terrain_bytes", "terrain MB", 1e-6},
                                                    {"position_m", "position m"},
                                                    {"shadow_percent", "shadow %"},
                                                    {"power_db", "power dB"},
                                                    {"gray_levels", "gray"}}};
inline constexpr std::array<std::string_view, 6> kMapFields{
    "latitude_deg", "longitude_deg", "altitude_ft", "target_latitude_deg", "target_longitude_deg", "window_nm"};

struct MapCost {
  double map_ms = 0.0;         // [ms] of the thread's processor time
  double terrain_bytes = 0.0;  // resident, of the window and the way to it
};

Values values_of(const MapCost& cost, const MapErrors& errors);
SceneRow row_of(const MapView& view);

}  // namespace yars::tools::trade
