// Errors of a scan against the ruler; light and shadow along its rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::tools::trade {

// What the middle ray of each sweep of a scan meets, sample by sample on the exact geodesic, and whether nearer ground
// hides it. Lit and shadow are those of the configuration's own algorithm, whatever its beam, smears and rays.
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

// What one fidelity makes of one scene, and how far that is from the ruler. Everything without noise. A comparison goes
// over the ruler's samples: each takes the nearest sample, in ground range, of the sweep with its azimuth.

// Sweep after sweep, samples from near to far.
struct Evidence {
  std::size_t sweeps = 0;
  std::size_t samples = 0;            // a sweep
  std::vector<float> power;           // full scale = 1, before the azimuth smear
  std::vector<std::uint8_t> video;    // as drawn, gain 3
  std::vector<std::uint8_t> seen;     // 1: no ground hides it, whatever beam and smear make of it
  std::vector<std::uint8_t> returns;  // 1: seen, and its facet looks towards the radar
  double position_m = 0.0;            // [m] farthest that a sample lies from its place on the geodesic
  bool power_is_radar = true;         // false: the 1996 report's intensity, a cosine
};

Evidence observe(const radar::RadarConfiguration& configuration, const model::kernel::ScanRequest& request,
                 const model::terrain::TerrainView& terrain);

struct Ruler {
  Evidence evidence;
  std::vector<std::uint8_t> ground;  // 1: there is some; 0: void
  double noise = 0.0;                // thermal noise, full scale = 1
};

Ruler make_ruler(const radar::RadarConfiguration& configuration, const model::kernel::ScanRequest& request,
                 const model::terrain::TerrainView& terrain);

struct Errors {
  double position_m = 0.0;      // [m]
  double shadow_percent = 0.0;  // [%] of the ruler's ground samples that one sees and the other does not
  double power_db = 0.0;        // [dB] RMS where both see ground and the ruler's stands above the noise; NaN: nowhere
  double gray_levels = 0.0;     // RMS of the video, of 255
};

// Both of one scene: as many sweeps.
Errors errors_against(const Ruler& ruler, const Evidence& found);

}  // namespace yars::tools::trade
