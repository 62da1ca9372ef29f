// Ground under the samples of the middle ray of each sweep of a scan, lit or in shadow.
// Inputs: a configuration, the positions of a scan's sweeps, terrain.
// Outputs: a RaySample for each sample of each sweep. Units: as the suffix of each name says; positions are WGS84.
#pragma once

#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::radar {

struct RadarConfiguration;

// Fraction of full scale, far below noise: a smaller power counts as none.
inline constexpr float kMinScanPower = 1e-8F;

// One sample of the middle ray of a sweep: position on the exact geodesic, ground, lit or in shadow. The configured
// algorithm computes `lit`. Beam, smears and number of rays do not change `lit`.
struct RaySample {
  double distance_m = 0.0;         // [m] ground range; NaN: no ground at the sample's slant range
  geo::GeoPoint position;          // the aircraft's position where distance_m is NaN
  model::terrain::Surface ground;  // void where distance_m is NaN
  bool lit = false;                // false: in shadow, void or not loaded
  // True: power above kMinScanPower, seen with a beam nearly 180 deg wide in elevation. Rain also gives power to
  // samples in shadow.
  bool returns = false;
};

// Samples of all sweeps: sweep after sweep, from near to far. Calls `goes_on` between sweeps; if it returns false,
// throws parallel::Stopped.
std::vector<RaySample> ray_samples(const RadarConfiguration& configuration,
                                   std::span<const model::kernel::SweepHeader> positions,
                                   const model::terrain::TerrainView& terrain, const parallel::GoesOn& goes_on = {});

}  // namespace yars::radar
