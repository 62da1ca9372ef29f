// Values derived from records: ground track, navigator's belief, radar command, map timer.
// Inputs: Ownship, Nav, RadarState and ModelStatus, all validated.
// Frame: WGS84 positions, true bearings.
// Threads: pure functions.
#pragma once

#include <optional>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"

namespace yars::radar {

// Direction of motion over ground: the axis of the scan and of the display. Below 1 m/s it is the heading, because
// noise dominates the direction of such a velocity.
geo::Bearing ground_track(geo::Speed north, geo::Speed east, geo::Bearing heading);

}  // namespace yars::radar

namespace yars::databuffer {

// The same for an ownship record.
geo::Bearing ground_track_of(const Ownship& ownship);

// Position that a navigator computes (`believed`), and the true position. Video is formed from the truth. Sequence
// points, and all positions reported to other systems, are the navigator's. `believed` is the navigator's position in
// Nav plus the error kept in the radar state.
struct NavigatorPosition {
  geo::GeoPoint truth;
  geo::GeoPoint believed;

  // Position on the video of a point with known coordinates: bearing and range from the believed position, laid off
  // from the true one. Without a navigation error the result is the input, bit for bit.
  geo::GeoPoint on_video(geo::GeoPoint known) const;
  // Inverse: coordinates that the navigator assigns to a position on the video.
  geo::GeoPoint coordinates_from_video(geo::GeoPoint position) const;
};

// NavigatorPosition of one navigator. A navigator that is all zeros or not finite counts as having the true position.
NavigatorPosition navigator_position(radar::Navigator navigator, const Ownship& ownship, const Nav& nav,
                                     const RadarState& state);

// NavigatorPosition of the navigator selected by the pilot.
NavigatorPosition selected_navigator_position(const Ownship& ownship, const Nav& nav, const RadarState& state);

// Fields of the radar state that control the radar model.
RadarCommand command_from_state(const RadarState& state);

// Map timer [s] as displayed. Source: docs/spec/pilots_interface.md#rule-6. While a map forms: its remaining time.
// Else: formation time of a map at the cursor, in RBM, HRM PPI and on a patch, with cursor function MAP, a window
// selected and the cursor mappable. nullopt: no display, or the model reports no number.
std::optional<double> map_timer_s(const RadarState& state, const ModelStatus& model);

}  // namespace yars::databuffer
