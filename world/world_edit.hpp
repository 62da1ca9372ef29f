// Edits of a world: what an instructor changes while the set flies. Pure functions on a WorldState.
// Inputs: a valid WorldState and the change. Outputs: the changed WorldState, without flag kWorldConfigured.
// Units: those of the record. Messages name limits in the units in which people give values: NM, ft, kt, deg.
// Errors: a value out of range, an unknown id, a full list, a name that another sequence point has. The world then
//   stays as it was.
// Use: inside databuffer::change_world() (session_world.hpp), so that no edit of another program is lost.
// Source: limits and defaults are those of lib/values/world_state.idl.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "databuffer/messages/world_state.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::world {

enum class WorldList : std::uint8_t { rain, jammers, movers, points };

// Calls call(std::type_identity<Entry>()) with the kind of a list's entries.
template <class Call>
auto for_list(WorldList list, const Call& call) {
  switch (list) {
    case WorldList::rain:
      return call(std::type_identity<databuffer::WorldRainCell>());
    case WorldList::jammers:
      return call(std::type_identity<databuffer::WorldJammer>());
    case WorldList::movers:
      return call(std::type_identity<databuffer::WorldMover>());
    case WorldList::points:
      break;
  }
  return call(std::type_identity<databuffer::WorldPoint>());
}

// Entries with the values that hold for what a user does not give.
databuffer::WorldRainCell default_rain_cell(geo::GeoPoint position);
databuffer::WorldJammer default_jammer(geo::GeoPoint position);
// `sim_time_ns`: sim time at which the mover is at `position`.
databuffer::WorldMover default_mover(geo::GeoPoint position, std::int64_t sim_time_ns);
// A steer point with the lowest number that is greater than those of all points, or else the lowest free one. Its
// elevation is unknown. Error: all numbers are in use.
error::Expected<databuffer::WorldPoint> default_point(const databuffer::WorldState& world, geo::GeoPoint position);

// Name of a jammer or mover: at most 15 characters of printable ASCII.
error::Expected<void> set_name(databuffer::WorldJammer& jammer, std::string_view name);
error::Expected<void> set_name(databuffer::WorldMover& mover, std::string_view name);
// Name of a sequence point: "2", target "2.", offset "2.1", target offset "2.01". A kind that does not fit the name
// becomes that of the name.
error::Expected<void> set_name(databuffer::WorldPoint& point, std::string_view name);

// Sequence points: an edit of a point sets kWorldPointsChanged. A name or number that another point has is refused. A
// target that is added or renamed makes the last steer point before it an initial point, as in a configuration.

// Add an entry with a new id and return the id; the id of the argument is not used.
template <class Entry>
error::Expected<std::uint32_t> add(databuffer::WorldState& world, Entry entry);

// Replace the entry with the id of the argument.
template <class Entry>
error::Expected<void> replace(databuffer::WorldState& world, const Entry& entry);

// Moves an entry to a position. A mover is there at `sim_time_ns`, and goes on with its speed and present heading.
error::Expected<void> move(databuffer::WorldState& world, WorldList list, std::uint32_t id, geo::GeoPoint position,
                           std::int64_t sim_time_ns);
// Gives a mover another speed and heading at its position at `sim_time_ns`.
error::Expected<void> steer(databuffer::WorldState& world, std::uint32_t id, double speed_mps, double heading_deg,
                            std::int64_t sim_time_ns);
// Entry with an id, to be changed by replace(). A mover is as it is at `sim_time_ns`.
template <class Entry>
error::Expected<Entry> entry_with(databuffer::WorldState& world, std::uint32_t id, std::int64_t sim_time_ns);
error::Expected<void> remove(databuffer::WorldState& world, WorldList list, std::uint32_t id);
// Add an entry that was removed again, with the id that it had. Errors: the list is full, or has an entry with this id.
template <class Entry>
error::Expected<void> restore(databuffer::WorldState& world, const Entry& entry);

// Sea state, WMO code 3700; NaN: from the wind.
error::Expected<void> set_sea_state(databuffer::WorldState& world, double state);
error::Expected<void> set_wind(databuffer::WorldState& world, double speed_mps, double from_deg);

// Preset of fidelity for sweeps, by its name; empty: as configured.
error::Expected<void> set_fidelity(databuffer::WorldState& world, std::string_view preset);

// Mover as it is at a sim time: position, heading and since_ns; all else is equal.
databuffer::WorldMover at_sim_time(const databuffer::WorldMover& mover, std::int64_t sim_time_ns);

}  // namespace yars::world
