// What the middle ray of each sweep of a scan meets, sample by sample on the exact geodesic, and whether nearer ground
// hides it. Lit and shadow are those of the configuration's own algorithm, whatever its beam, smears and rays.
#pragma once

#include <span>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/sweep_record.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::tools::trade {

struct RaySample {
  double distance_m = 0.0;         // [m] over ground; NaN = nothing is that near (slant range)
  geo::GeoPoint place;             // the aircraft's where the distance is NaN
  model::terrain::Surface ground;  // void where the distance is NaN
  bool lit = false;                // false: in shadow, or nothing known is there
  bool returns = false;            // lit, and its facet looks towards the radar: a whole-sky beam has power from it
};

// Sweep after sweep, samples from near to far.
std::vector<RaySample> ray_samples(const radar::RadarConfiguration& configuration,
                                   std::span<const model::kernel::SweepPlace> places,
                                   const model::terrain::TerrainView& terrain);

}  // namespace yars::tools::trade
