// What a trade (a run of `yars trade`) measures. A scene is the geometry of one scan; a map view is the geometry of one
// patch map. Also the columns of the result tables.
// Units: degrees, feet, nautical miles, as in the field names.
// Errors: scene_of() and map_view_of() return an Error of bad usage.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/kernel/offline_scan.hpp"
#include "tools/trade/trade_errors.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

// Aircraft position, altitude above mean sea level, true heading and range scale of one scan.
struct Scene {
  geo::GeoPoint position;
  double altitude_ft = 15000.0;
  double heading_deg = 60.0;
  double range_nm = 40.0;
};

// Parses a scene "LAT,LON,ALT_FT,HDG,RANGE_NM". Errors: not five numbers, or a number out of its range.
error::Expected<Scene> scene_of(std::string_view text);

// Name of a scene, such as "37 -122 15000 ft 60 deg 40 NM".
std::string scene_name(const Scene& scene);

// One scan of the scene. The antenna points at sea level at the end of the range, as a cosecant-squared beam needs. The
// elevation is computed for a flat earth with any fidelity. It is clamped between the lower limit of the gimbal and the
// horizontal.
model::kernel::ScanRequest request_of(const Scene& scene, geo::Angle width, const radar::AntennaConfiguration& antenna);

// Aircraft position, altitude above mean sea level, target (centre) and window of one patch map.
struct MapView {
  geo::GeoPoint position;  // position of the aircraft
  double altitude_ft = 15000.0;
  geo::GeoPoint target;
  double window_nm = 3.3;
};

// Parses a view "LAT,LON,ALT_FT,TARGET_LAT,TARGET_LON,WINDOW_NM". Errors: not six numbers, a number out of its range, a
// target that is not farther away than the window is wide.
error::Expected<MapView> map_view_of(std::string_view text);

// Name of a view, such as "37.8 -122.3 3.3 NM from 20 NM, 15000 ft".
std::string map_view_name(const MapView& view);

// View with the aircraft at this distance and bearing (true) from the target.
MapView view_of_target(geo::GeoPoint target, double distance_nm, double bearing_deg, double altitude_ft,
                       double window_nm);

// One map of the view with one look, from an aircraft at 480 kt over ground. The target lies 90 deg right of the ground
// track, so no pixel is in the blind zone.
model::hrm::PatchOrder order_of(const MapView& view);

// Columns of the result table of `yars trade`.
enum ScanColumn : std::size_t {
  kScanMs,
  kSamplesPerSecond,
  kScanTerrainBytes,
  kScanPosition,
  kScanShadow,
  kScanPower,
  kScanGray,
  kScanBrightness
};
inline constexpr std::array<Column, 8> kScanColumns{{{"scan_ms", "ms a scan"},
                                                     {"samples_per_second", "M samples/s", 1e-6, true},
                                                     {"terrain_bytes", "terrain MB", 1e-6},
                                                     {"position_m", "position m"},
                                                     {"shadow_percent", "shadow %"},
                                                     {"power_db", "power dB"},
                                                     {"gray_levels", "gray"},
                                                     {"brightness_db", "brightness dB"}}};
inline constexpr std::array<std::string_view, 5> kScanFields{"latitude_deg", "longitude_deg", "altitude_ft",
                                                             "heading_deg", "range_nm"};

struct Cost {
  double scan_ms = 0.0;  // [ms] thread CPU time
  double samples_per_second = 0.0;
  double terrain_bytes = 0.0;  // [bytes] terrain in memory
};

Values values_of(const Cost& cost, const Errors& errors);
SceneRow row_of(const Scene& scene);

// Columns of the result table of `yars trade maps`.
enum MapColumn : std::size_t {
  kMapMs,
  kMapTerrainBytes,
  kMapPosition,
  kMapShadow,
  kMapPower,
  kMapGray,
  kMapBrightness
};
inline constexpr std::array<Column, 7> kMapColumns{{{"map_ms", "ms a map"},
                                                    {"terrain_bytes", "terrain MB", 1e-6},
                                                    {"position_m", "position m"},
                                                    {"shadow_percent", "shadow %"},
                                                    {"power_db", "power dB"},
                                                    {"gray_levels", "gray"},
                                                    {"brightness_db", "brightness dB"}}};
inline constexpr std::array<std::string_view, 6> kMapFields{
    "latitude_deg", "longitude_deg", "altitude_ft", "target_latitude_deg", "target_longitude_deg", "window_nm"};

struct MapCost {
  double map_ms = 0.0;         // [ms] thread CPU time
  double terrain_bytes = 0.0;  // [bytes] terrain in memory, for the window and the path from the aircraft to it
};

Values values_of(const MapCost& cost, const MapErrors& errors);
SceneRow row_of(const MapView& view);

}  // namespace yars::tools::trade
