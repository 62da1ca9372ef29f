// One patch map (high resolution map).
// Inputs: radar, terrain, request, scene, movers. Outputs: video, power, labels, and where the pixels lie.
// Order of arrays: row 0 is the far edge, column 0 the left one as seen from the aircraft.
// Frame: azimuthal equidistant plane about the aircraft.
// Errors: as yars/radar.hpp says. Threads: one caller at a time; the computation uses PatchRequest::threads.
// Determinism: equal inputs give equal bits, for any number of threads.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
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

// Labels to compute. surfaces: shadow, layover, object, material. heights: height and grazing angle, too.
enum class LabelUse : std::uint8_t { none, surfaces, heights };

// Scenes and movers on the ground, and the labels to compute.
struct PatchSubject {
  const Scene* scene = nullptr;  // null: the scenes in the terrain's folder, and those of the configuration
  std::span<const Mover> movers{};
  LabelUse labels = LabelUse::none;
};

// Labels by pixel, of the surface with the strongest return there. In the blind zone: none.
struct PatchLabels {
  std::span<const std::uint8_t> shadow;    // 1: no surface that the radar sees returns here
  std::span<const std::uint8_t> layover;   // 1: two or more separate surfaces that the radar sees have this slant range
  std::span<const std::int32_t> object;    // index into Scene::objects(); -1: ground, or shadow
  std::span<const std::uint8_t> material;  // code of DFAD; 0: land without culture, or shadow
  std::span<const float> height_m;         // above mean sea level; NaN in shadow
  std::span<const float> sin_grazing;      // sine of the grazing angle on the line of sight; NaN in shadow
};

struct PatchFacts {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0, ground_track_deg = 0.0;  // of the aircraft
  double target_latitude_deg = 0.0, target_longitude_deg = 0.0, target_height_m = 0.0;       // of the map's centre
  double window_m = 0.0;                                                                     // side of the map
  double up_deg = 0.0;  // true bearing of the map's centre from the aircraft
  double ground_range_m = 0.0, slant_range_m = 0.0, grazing_deg = 0.0;  // of the map's centre
  double resolution_m = 0.0;                                            // edge of a resolution cell
  double formation_s = 0.0;                                             // time in which the radar forms the map
  // Position on the plane from column c and row r, in GDAL's order: x = p[0] + c p[1] + r p[2] east [m] of the
  // aircraft, y = p[3] + c p[4] + r p[5] north [m].
  std::array<double, 6> plane_from_pixel{};
  int looks = 0;
  std::string preset;
  std::size_t triangles = 0;      // of the scenes near the window
  std::size_t terrain_bytes = 0;  // memory of what was read
  std::size_t threads = 0;
};

// Where the centres of the pixels lie on the map's plane, row after row.
struct PatchPositions {
  std::vector<double> latitude_deg, longitude_deg, ground_range_m, slant_range_m;
};

class YARS_EXPORT Patch {
 public:
  // Names of the steps of run(), for Call::progress.
  static std::span<const std::string_view> steps();

  // Checks the request and reads what the map needs. run() then computes.
  static Expected<Patch> prepare(const Radar& radar, const Terrain& terrain, const PatchRequest& request,
                                 const PatchSubject& subject = {}, const Call& call = {});
  // Prepares another map in the memory of this one, with its radar, size, labels, threads and seed.
  Expected<void> prepare_next(const Terrain& terrain, const PatchRequest& request, const PatchSubject& subject = {},
                              const Call& call = {});
  // Computes the map; again with equal bits.
  Expected<void> run(const Call& call = {});
  // Ends the threads of the computation and frees its memory. Results stay.
  void finish();

  int size() const;                             // pixels on an edge
  std::span<const std::uint8_t> video() const;  // 0 black to 255 white
  // Gamma of level ground with equal return, before speckle and noise; -1: in the blind zone. With the preset 1996:
  // brightness 0 to 1.
  std::span<const float> power() const;
  PatchLabels labels() const;
  std::uint64_t hash() const;  // XXH3 of the video, as `yars patch` prints it
  PatchFacts facts() const;
  PatchPositions positions() const;
  // Files and parts of files that are missing from the terrain and the scenes of this map: one sentence each.
  const std::vector<std::string>& left_out() const;

  struct Work;  // used by the library
  const Work& work() const { return *work_; }
  explicit Patch(std::unique_ptr<Work> work);
  Patch(Patch&&) noexcept;
  Patch& operator=(Patch&&) noexcept;
  ~Patch();

 private:
  std::unique_ptr<Work> work_;
};

}  // namespace yars
