// One scan of the real beam map.
// Inputs: radar, terrain, request, scene. Outputs: power, video and hash of each sweep; labels of each sample.
// Order of arrays: sweep by sweep clockwise, samples from near to far.
// Errors: as yars/radar.hpp says. Threads: one caller at a time; the computation uses ScanRequest::threads.
// Determinism: equal inputs give equal bits, for any number of threads.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "yars/call.hpp"
#include "yars/error.hpp"
#include "yars/requests.hpp"
#include "yars/scene.hpp"
#include "yars/terrain.hpp"

namespace yars {

class Radar;

// One sweep of a scan. The spans are valid as long as the Scan.
struct ScanSweep {
  double azimuth_left_deg = 0.0;        // true bearing of the left edge at the aircraft
  double azimuth_right_deg = 0.0;       // of the right edge
  double azimuth_deg = 0.0;             // of the middle
  std::uint64_t hash = 0;               // XXH3 of the record: place, settings, video
  std::span<const std::uint8_t> video;  // 0 black to 255 white
  std::span<const float> power;         // before noise and azimuth smear; 1: full scale
};

// Labels of all samples. Where no ground has the sample's slant range, and over voids, numbers are NaN.
struct ScanLabels {
  std::vector<std::uint8_t> shadow;    // 1: no surface that the radar sees returns here
  std::vector<std::uint8_t> layover;   // 1: two or more separate surfaces that the radar sees have this slant range
  std::vector<std::uint8_t> material;  // code of DFAD; 0: land without culture, 6: water
  std::vector<std::int32_t> object;    // index into Scene::objects(); -1: ground
  std::vector<double> ground_range_m, slant_range_m;
  std::vector<double> latitude_deg, longitude_deg;
  std::vector<float> height_m;     // of the surface above mean sea level
  std::vector<float> grazing_deg;  // between line of sight and surface, along the line of sight
};

struct ScanFacts {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;  // of the aircraft
  double ground_track_deg = 0.0, elevation_deg = 0.0, range_m = 0.0;
  bool slant_range_samples = false;  // true: samples are even in slant range; false: in ground range
  std::string preset;
  std::size_t rays = 0;                            // rays that were measured; sweeps share them
  std::size_t terrain_bytes = 0, scene_bytes = 0;  // memory of what was read
};

class YARS_EXPORT Scan {
 public:
  // Checks the request and reads what the scan needs. run() then computes.
  static Expected<Scan> prepare(const Radar& radar, const Terrain& terrain, const ScanRequest& request,
                                const Scene* scene = nullptr, const Call& call = {});
  // Computes power, video and hashes; again with equal bits.
  Expected<void> run(const Call& call = {});
  // Computes the power alone.
  void measure();
  // Ends the threads of the computation. Results stay.
  void finish();

  std::size_t sweeps() const;
  std::size_t samples() const;           // of a sweep
  std::span<const float> power() const;  // of all samples
  // Error: there is no sweep of this index, [0, sweeps()).
  Expected<ScanSweep> sweep(std::size_t index) const;
  std::uint64_t hash() const;  // of the hashes of all sweeps, as `yars scan` prints it
  ScanFacts facts() const;     // also before run()
  // Files and parts of files that are missing from the terrain and the scenes of this scan: one sentence each.
  const std::vector<std::string>& left_out() const;
  // Computed at the first call, also before run().
  Expected<const ScanLabels*> labels(const Call& call = {});

  struct Work;  // used by the library
  const Work& work() const { return *work_; }
  explicit Scan(std::unique_ptr<Work> work);
  Scan(Scan&&) noexcept;
  Scan& operator=(Scan&&) noexcept;
  ~Scan();

 private:
  std::unique_ptr<Work> work_;
};

}  // namespace yars
