// JSON objects of the instructor's map: aircraft, scan, patch maps; sequence points, beacons, route.
// Inputs: valid records of the session; the configuration; waypoints of the route.
// Outputs: objects for docs/station.md#messages. Positions are WGS84 in degrees; unknown values are null.
// Errors: none. Threads: any; functions without state.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "lib/geo/geodesy.hpp"

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
