// Values derived from records: ground track, navigator's position, radar command, map timer, remedies of silent parts.
// Hashes of pictures (XXH3, 64 bits), by which a reader recognizes equal, damaged and torn ones.
// Inputs: Ownship, Nav, RadarState and ModelStatus, all validated; a sweep; a patch map with its pixels.
// Frame: WGS84 positions, true bearings.
// Threads: pure functions.
// Source of the hashes: xxHash, https://github.com/Cyan4973/xxHash, XXH3_64bits.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/sensor.hpp"

namespace yars::radar {

// Direction of motion over ground, which points up on the display. Below 1 m/s the result is `heading`, because noise
// then dominates the direction of the velocity.
geo::Bearing ground_track(geo::Speed north, geo::Speed east, geo::Bearing heading);

}  // namespace yars::radar

namespace yars::databuffer {

// What to do about a silent part of the set: remedies of NO OWNSHIP, NO MODEL and NO STATE MACHINE. A line of the
// display has space for 43 characters. Source: docs/pilots_manual.md#remedies.
inline constexpr const char* kRemedyNoOwnship = "see yars status, or start a flight-model";
inline constexpr const char* kRemedyNoModel = "start radar-model; yars status says more";
inline constexpr const char* kRemedyNoStateMachine = "start state-machine; yars status says more";

// ground_track() of an ownship record.
geo::Bearing ground_track_of(const Ownship& ownship);

// Attitude and ground track of an ownship record.
radar::Platform platform_of(const Ownship& ownship);

// The aircraft's true position (`truth`), and the position that a navigator estimates (`estimated`). The model forms
// video as seen from `truth`. Sequence points and all positions reported to other systems are in the navigator's
// coordinates. `estimated` is the navigator's position in Nav plus the navigator's error in the radar state.
struct NavigatorPosition {
  geo::GeoPoint truth;
  geo::GeoPoint estimated;

  // True ground position at which the display draws the symbol of a point. `known`: the point in the navigator's
  // coordinates. Seen from `truth`, the result has the bearing and range that `known` has from `estimated`. Without a
  // navigation error the result equals `known` bit for bit.
  geo::GeoPoint on_video(geo::GeoPoint known) const;
  // Inverse of on_video(): coordinates that the navigator assigns to a true ground position.
  geo::GeoPoint coordinates_from_video(geo::GeoPoint position) const;
};

// NavigatorPosition of one navigator. If Nav has 0 N 0 E or no finite position for the navigator, the true position is
// used instead.
NavigatorPosition navigator_position(radar::Navigator navigator, const Ownship& ownship, const Nav& nav,
                                     const RadarState& state);

// NavigatorPosition of the navigator selected by the pilot.
NavigatorPosition selected_navigator_position(const Ownship& ownship, const Nav& nav, const RadarState& state);

// Copies the fields of the radar state that control the radar model.
RadarCommand command_from_state(const RadarState& state);

// Map timer [s] as displayed (docs/pilots_manual.md#rule-6). While a map forms, it is the remaining time.
// While no map forms, it is the formation time of a map at the cursor. It is then displayed only if resume_mode is RBM,
// HRM PPI or patch, the cursor function is MAP, a window is selected, and a map can be commanded at the cursor.
// nullopt: the display shows no timer.
std::optional<double> map_timer_s(const RadarState& state, const ModelStatus& model);

// Hash of apex, altitude, edges, ground track, antenna elevation and range. It seeds the hash over the video samples in
// use, which is the result.
std::uint64_t sweep_hash(const Sweep& sweep);

// Hash of a patch map's pixels. The seed is the hash of the map's twelve geometry fields. Ids and ticks are not hashed,
// so equal maps have equal hashes.
std::uint64_t map_hash(const PatchMap& map, std::span<const std::uint8_t> pixels);

}  // namespace yars::databuffer
