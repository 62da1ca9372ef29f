// Elevations of what the pilot designates. A point is stored at once; how high its ground lies is the model's to tell,
// a tick or more later, and by then the cursor may be elsewhere. So the state names the ground that it asks for, the
// model answers with the same coordinates, and only that answer is taken.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/geo/geodesic.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// [m] MSL of this ground, NaN where the model does not know it; nothing while it has not answered.
std::optional<double> answered_elevation_m(const Surroundings& surroundings, geo::GeoPoint ground);

// The ground under the cursor is asked for on behalf of those (databuffer::kAskedFor..., a bit for a mark). Their
// elevation is unknown until take_elevation() has it.
void ask_elevation(Step& step, std::uint32_t for_whom);
// Those have an elevation of their own.
void ask_no_more(databuffer::RadarState& state, std::uint32_t for_whom);

// True if the event designates a point while another one's elevation is awaited: whoever takes events leaves it for a
// later tick. Not for longer than 20 ticks, for the model may be gone.
bool waits_for_elevation(const databuffer::RadarState& state, const databuffer::InputEvent& event,
                         const Surroundings& surroundings);

// A tick: an answer that has come goes to those who wait for it.
void take_elevation(databuffer::RadarState& state, const Surroundings& surroundings);
// Nobody waits: the cursor's ground is asked for.
void ask_for_cursor(databuffer::RadarState& state);

}  // namespace yars::statemachine
