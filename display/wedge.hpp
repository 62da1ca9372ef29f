// A stored sweep as it lies in the present frame, on the glass.
#pragma once

#include <vector>

#include "display/glass_geometry.hpp"
#include "display/polar_store.hpp"

namespace yars::display {

struct Wedge {
  Point apex;               // where the aircraft was
  Point left, right;        // unit vectors along the edges
  float range = 0.0F;       // [units] of the far end
  float half_width = 0.0F;  // [rad]
  int row = 0;              // of PolarStore::video
  int samples = 0;
  std::uint64_t serial = 0;
};

// All sweeps of the store, oldest first. A sweep's plan is flat about its own apex: exact in range and azimuth
// there; the apex itself is off by distance^3 / (6 R^2), 0.1 m after 30 km of flight.
void place_wedges(const PolarStore& store, const GlassView& view, const GlassFrame& frame, std::vector<Wedge>& wedges);

}  // namespace yars::display
