// What a navigator believes, against what is true. Video is made from the truth; sequence points, and all that is told
// to others, are the navigator's. Its belief is what the lane says plus the error that the state machine keeps.
#pragma once

#include "databuffer/records/ownship.hpp"
#include "databuffer/records/radar_state.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/radar/modes.hpp"

namespace yars::databuffer {

// Which way it goes over ground; below walking speed its heading.
geo::Bearing ground_track_of(const Ownship& ownship);

// The aircraft as it is and as a navigator has it.
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

}  // namespace yars::databuffer
