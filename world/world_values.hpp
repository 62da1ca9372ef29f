// The part of the world's configuration that an instructor changes at run time, as a record and back.
// Units: those of the record (world_state.idl), of radar::WorldConfiguration and of radar::RoutePoint.
// Accuracy: apply(world_state_from(world), other) gives `other` the sea state, wind, rain cells, jammers and movers of
// `world`, bit by bit. Only the names may differ: the record has their first 15 characters, in printable ASCII.
#pragma once

#include <span>
#include <vector>

#include "databuffer/messages/world_state.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/world.hpp"

namespace yars::world {

// Record of a configured world and route: flag kWorldConfigured, edit 0. The ids of each list count up from 1.
databuffer::WorldState world_state_from(const radar::WorldConfiguration& world,
                                        std::span<const radar::RoutePoint> route = {});

// Replaces sea state, wind, rain cells, jammers and movers of `world` by those of a valid record. All else stays.
void apply(const databuffer::WorldState& state, radar::WorldConfiguration& world);

// Sequence points of a valid record, in its order.
std::vector<radar::RoutePoint> route_of(const databuffer::WorldState& state);

}  // namespace yars::world
