// Edits of a world: what an instructor changes while the set flies. Pure functions on a WorldState.
// Inputs: a valid WorldState and the change. Outputs: the changed WorldState, without flag kWorldConfigured.
// Units: those of the record. Messages name limits in the units in which people give values: NM, ft, kt, deg.
// Errors: a value out of range, an unknown id, a full list, a name that another sequence point has. The world then
//   stays as it was.
// Use: inside databuffer::change_world() (session_changes.hpp), so that no edit of another program is lost.
// Source: limits and defaults are those of lib/values/world_state.idl.
#pragma once

#include <cstdint>
#include <string_view>

#include "databuffer/messages/world_lists.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::world {

using databuffer::WorldEntry;
using databuffer::WorldList;

// An entry with the values that hold for what a user does not give. `sim_time_ns`: time at which a mover is at
// `position`. A sequence point becomes a steer point with the lowest number that is greater than those of all points,
// or else the lowest free one. Error: all numbers are in use.
error::Expected<WorldEntry> default_entry(const databuffer::WorldState& world, WorldList list, geo::GeoPoint position,
                                          std::int64_t sim_time_ns);

// Name: printable ASCII, as long as the record has room for. That of a sequence point is "2", target "2.", offset "2.1"
// or target offset "2.01"; a kind that does not fit the name becomes that of the name.
error::Expected<void> set_name(WorldEntry& entry, std::string_view name);

// Sequence points: an edit of a point sets kWorldPointsChanged. A name or number that another point has is refused. A
// target that is added or renamed makes the last steer point before it an initial point, as in a configuration.

// Add an entry with a new id and return the id; the id of the argument is not used.
error::Expected<std::uint32_t> add(databuffer::WorldState& world, WorldEntry entry);
// Replace the entry with the id of `entry`.
error::Expected<void> replace(databuffer::WorldState& world, const WorldEntry& entry);
// Moves an entry to a position. A mover is there at `sim_time_ns`, and goes on with its speed and present heading.
error::Expected<void> move(databuffer::WorldState& world, WorldList list, std::uint32_t id, geo::GeoPoint position,
                           std::int64_t sim_time_ns);
// Gives a mover another speed and heading at its position at `sim_time_ns`.
error::Expected<void> steer(databuffer::WorldState& world, std::uint32_t id, double speed_mps, double heading_deg,
                            std::int64_t sim_time_ns);
// Entry with an id, to be changed by replace(). A mover is as it is at `sim_time_ns`.
error::Expected<WorldEntry> entry_with(const databuffer::WorldState& world, WorldList list, std::uint32_t id,
                                       std::int64_t sim_time_ns);
error::Expected<void> remove(databuffer::WorldState& world, WorldList list, std::uint32_t id);
// Add an entry that was removed again, with the id that it had. Errors: the list is full, or has an entry with this id.
error::Expected<void> restore(databuffer::WorldState& world, const WorldEntry& entry);

// Sea state, WMO code 3700; NaN: from the wind.
error::Expected<void> set_sea_state(databuffer::WorldState& world, double state);
error::Expected<void> set_wind(databuffer::WorldState& world, double speed_mps, double from_deg);

// Preset of fidelity for sweeps, by its name; empty: as configured.
error::Expected<void> set_fidelity(databuffer::WorldState& world, std::string_view preset);

// Mover as it is at a sim time: position, heading and since_ns; all else is equal.
databuffer::WorldMover at_sim_time(const databuffer::WorldMover& mover, std::int64_t sim_time_ns);

}  // namespace yars::world
