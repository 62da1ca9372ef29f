// The frame in which everything is drawn: ground track up, own apex; frozen, the last sweep's [design "The glass"].
#pragma once

#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"
#include "display/polar_store.hpp"

namespace yars::display {

// `newest` is the last sweep of the mode shown, or null.
GlassFrame present_frame(const GlassInput& input, const StoredSweep* newest);

}  // namespace yars::display
