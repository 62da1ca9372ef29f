// Values derived from records: ground track, navigator's belief, radar command, map timer.
#pragma once

#include <optional>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"

namespace yars::radar {

// Which way the aircraft goes over ground: the axis of the scan and of the glass. Direction of the velocity; below 1
// m/s, where a velocity has no direction worth following, the heading.
geo::Bearing ground_track(geo::Speed north, geo::Speed east, geo::Bearing heading);

}  // namespace yars::radar

namespace yars::databuffer {

// Which way it goes over ground; below walking speed its heading.
geo::Bearing ground_track_of(const Ownship& ownship);

// What a navigator believes, against what is true. Video is made from the truth; sequence points, and all that is told
// to others, are the navigator's. Its belief is what the lane says plus the error that the state machine keeps.
struct Belief {
  geo::GeoPoint truth;
  geo::GeoPoint believed;

  // Where the video shows a place that the navigator knows by its coordinates: bearing and range from where it believes
  // to be, laid off from where the aircraft is. Without an error the place itself, to the last bit.
  geo::GeoPoint on_video(geo::GeoPoint known) const;
  // The coordinates that the navigator gives to a place on the video: the inverse.
  geo::GeoPoint known_from_video(geo::GeoPoint place) const;
};

// A lane that gives no navigator (zeros, or no numbers) is taken for one that knows the truth.
Belief belief_of(radar::Navigator navigator, const Ownship& ownship, const Nav& nav, const RadarState& state);

// Of the navigator that the pilot has chosen.
Belief belief_in_use(const Ownship& ownship, const Nav& nav, const RadarState& state);

// The part of the radar state that the model acts on.
RadarCommand command_from_state(const RadarState& state);

// When the pilot is told how long a patch map takes. Source: docs/spec/pilots_interface.md#rule-6. Time left [s] of the
// map that forms; else what one at the cursor would take, in RBM, HRM PPI and on a patch, with cursor MAP, a window
// selected and the cursor mappable. Nothing when the model tells no number.
std::optional<double> map_timer_s(const RadarState& state, const ModelStatus& model);

}  // namespace yars::databuffer
