// Instructor's map: tiles, and JSON objects of aircraft, scan, patch maps, sequence points, beacons and route. Tiles
// are squares in degrees. Tile (level, row, column) has edges of kTileEdge_deg / 2^level; row 0 begins at the south
// pole, column 0 at 180 degrees west. Inputs: the path of a request, /map/LEVEL/ROW/COLUMN.png; valid records of the
// session; the configuration; waypoints of the route.
// Outputs: the tile, its frame in degrees and pixels; objects. Positions are WGS84 in degrees; unknown values are null.
// Errors: a path that names no tile gives nullopt. Threads: any; functions without state.
// Source: docs/station.md#the-map and #messages.
#pragma once

#include <compare>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "model/terrain/picture/hill_shade.hpp"

namespace yars::station {

inline constexpr double kTileEdge_deg = 8.0;  // of level 0
inline constexpr int kMaxTileLevel = 12;      // 217 m of latitude, 0.85 m a pixel
inline constexpr int kTilePixels = 256;

struct MapTile {
  int level = 0, row = 0, column = 0;
  auto operator<=>(const MapTile&) const = default;
};

std::optional<MapTile> tile_of_path(std::string_view path);
model::terrain::MapFrame frame_of(const MapTile& tile);

}  // namespace yars::station

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::station {

// Aircraft of the radar; null without a fresh one.
nlohmann::ordered_json aircraft_json(const databuffer::ModelStatus& model);

// Sector that the antenna scans and the direction of the beam [deg true], range [NM]; null without an aircraft.
nlohmann::ordered_json scan_json(const databuffer::ModelStatus& model);

// A complete patch map: id, centre, window, corners from the far left one clockwise.
nlohmann::ordered_json patch_json(const databuffer::PatchMap& map);
// The patch map that is being formed, with its progress; null without one.
nlohmann::ordered_json forming_json(const databuffer::ModelStatus& model);

// Position errors of the navigators [ft].
nlohmann::ordered_json navigators_json(const databuffer::RadarState& state);

// A place with a name, such as a town.
struct Place {
  std::string name;
  geo::GeoPoint position;
};

// What does not change while the station runs: sequence points, beacons, scenes, waypoints of the route, keys.
nlohmann::ordered_json theatre_json(const radar::RadarConfiguration& configuration, const std::vector<Place>& scenes,
                                    const std::vector<geo::GeoPoint>& route);

}  // namespace yars::station
