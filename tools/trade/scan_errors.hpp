// Errors of a scan against the ruler, the scan of the reference algorithm.
// Units: metres, percent of samples, dB RMS, gray levels RMS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "radar/ray_samples.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::tools::trade {

// Long functions here ask `goes_on` between sweeps, and throw parallel::Stopped.

// One scan computed with one fidelity, without noise. Order of the arrays: sweep by sweep, from near to far.
struct ScanObservation {
  std::size_t sweeps = 0;
  std::size_t samples = 0;            // samples of one sweep
  std::vector<float> power;           // full scale = 1, before the azimuth smear
  std::vector<std::uint8_t> video;    // 0 to 255, gain of the request
  std::vector<std::uint8_t> seen;     // RaySample::lit
  std::vector<std::uint8_t> returns;  // RaySample::returns
  // [m] maximum distance of a sample from its exact position, over every 4th sample of every 4th sweep.
  double position_m = 0.0;
  bool power_is_radar = true;  // false: `power` is the brightness of 1996, from the cosine of the incidence angle
};

ScanObservation observe(const radar::RadarConfiguration& configuration, const model::kernel::ScanRequest& request,
                        const model::terrain::TerrainView& terrain, const parallel::GoesOn& goes_on = {});

// Scan of the reference algorithm, with which other scans are compared.
struct Ruler {
  ScanObservation observation;
  std::vector<std::uint8_t> ground;  // 1: elevation known; 0: void, not loaded, or no ground at the slant range
  double noise = 0.0;                // thermal noise, full scale = 1
};

Ruler make_ruler(const radar::RadarConfiguration& configuration, const model::kernel::ScanRequest& request,
                 const model::terrain::TerrainView& terrain, const parallel::GoesOn& goes_on = {});

struct Errors {
  double position_m = 0.0;      // [m] ScanObservation::position_m of the compared scan
  double shadow_percent = 0.0;  // [%] share of the ruler's samples with known ground that are lit in one scan only
  // [dB] RMS ratio of powers, over samples with known ground that return power in both scans and exceed the noise in
  // the ruler. NaN: there is no such sample, or the compared scan is by the algorithm of 1996.
  double power_db = 0.0;
  double gray_levels = 0.0;  // [0 to 255] RMS difference of the video
};

// Compares each sample of the ruler with the sample of `found` that contains its middle, in the same sweep.
// Requires scans of the same scene, with equal numbers of sweeps.
Errors errors_against(const Ruler& ruler, const ScanObservation& found);

}  // namespace yars::tools::trade
