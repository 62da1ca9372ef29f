// The frame in which everything is drawn: ground track up, own apex; frozen, the last sweep's [design "The glass"].
#pragma once

#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"
#include "display/polar_store.hpp"

namespace yars::display {

geo::Bearing ground_track_of(const databuffer::Ownship& ownship);

// `newest` is the last sweep of the mode shown, or null.
GlassFrame present_frame(const GlassInput& input, const StoredSweep* newest);

// Symbols are placed by the navigator chosen: a place that it believes in is drawn where the error of the
// navigator moves it against the video. Without a navigator's position the place stays.
geo::GeoPoint seen_through_navigator(const GlassInput& input, geo::GeoPoint place);

}  // namespace yars::display
