// The record of surface traffic from the entities of an exercise: platforms on land and on the sea. What they return is
// not told by their packets and is taken by domain; more than fit are left out, the farthest first.
#pragma once

#include <span>

#include "databuffer/bridges/entity_table.hpp"
#include "databuffer/records/traffic.hpp"
#include "lib/geo/geodesic.hpp"

namespace yars::databuffer::bridges {

// Echo of a lorry and of a freighter at X band (Skolnik, Introduction to Radar Systems, table of cross sections; a
// ship's 52 f^(1/2) D^(3/2) with f 10 GHz in MHz and D 2 kt), and the height of what returns.
inline constexpr double kVehicleEcho_m2 = 200.0, kVehicleHeight_m = 3.0;
inline constexpr double kShipEcho_m2 = 15'000.0, kShipHeight_m = 15.0;

// `near`: the aircraft. Epoch and stamp are the caller's to fill.
Traffic surface_traffic(std::span<const TrackedEntity> entities, geo::GeoPoint near);

}  // namespace yars::databuffer::bridges
