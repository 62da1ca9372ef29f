// Errors of a patch map and of a scan against the ruler, the map or scan of the reference algorithm. Position errors of
// a map are measured with marks: bright squares on the ground (no relation to the cursor function MARK).
// Units: metres, percent of pixels or samples, dB RMS, gray levels RMS, dB of the mean power; times are thread CPU time
// [ms].
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "radar/theatre.hpp"

namespace yars::radar {
struct RadarConfiguration;
}  // namespace yars::radar

namespace yars::tools::trade {

inline constexpr int kMarksPerEdge = 3;  // marks along one edge of the window

// Scene of bright squares (marks) on the ground of a map's window. Their positions in two maps give the position error
// of one fidelity against the other. The squares lie on the terrain, so layover displaces them like the terrain.
class MarkScene final : public model::scene::SceneView {
 public:
  // kMarksPerEdge x kMarksPerEdge squares, evenly spaced. The side of a square is 3 % of the window's side.
  explicit MarkScene(const model::hrm::PatchOrder& order);

  std::uint64_t generation() const override { return 1; }
  std::uint64_t resident_bytes() const override { return 0; }
  const std::vector<model::scene::SurfaceKind>& kinds() const override { return kinds_; }
  const std::vector<model::scene::SceneObject>& objects() const override { return objects_; }
  void tiles_near(geo::GeoPoint position, double radius_m,
                  std::vector<const model::scene::Tile*>& found) const override;

 private:
  void add(geo::GeoPoint centre, double edge_m);

  std::vector<model::scene::Tile> tiles_;
  std::vector<model::scene::SurfaceKind> kinds_;
  std::vector<model::scene::SceneObject> objects_;
};

// The configuration, changed so that the marks of a MarkScene return far more power than water, and other land returns
// none. Ground whose culture is the marks' material (metal) returns as much as a mark. mapDetail (texture) and
// mapResponse (sidelobes) are off, and there are no movers.
radar::RadarConfiguration marks_alone(radar::RadarConfiguration configuration);

// One map computed with one fidelity, without noise and speckle. Noise would count as an error, because another
// fidelity draws different random numbers.
struct MapObservation {
  int size = 0;                                            // [pixels] edge of the map
  std::vector<float> power;                                // gamma of level ground of equal return; 1996: brightness
  std::vector<std::uint8_t> dark;                          // 1: less than 5 % of the power of level ground
  std::vector<std::uint8_t> video;                         // 0 to 255
  std::vector<std::optional<model::hrm::MapPoint>> marks;  // apparent position of each mark; nullopt: hidden
  bool power_is_radar = true;                              // false: `power` is the brightness of 1996
  double noise = 0.0;                                      // thermal noise, as gamma of level ground
  double took_ms = 0.0;                                    // [ms] time of the map without marks, by `clock`
};

// Function that returns the CPU time of the thread [ms]. It is a parameter, because only the commands read clocks.
using Clock = double (*)();

// Forms the map of the order, and a second map of the same ground with marks. Both functions ask `goes_on` between the
// steps of a map, and throw parallel::Stopped.
MapObservation observe_map(const radar::RadarConfiguration& configuration, const model::hrm::PatchOrder& order,
                           const model::hrm::PatchEnvironment& environment, Clock clock,
                           const parallel::GoesOn& goes_on = {});

// Forms one map, from the order to the video, with noise as configured. Returns the CPU time [ms].
double time_map(model::hrm::PatchFormation& patch_formation, const model::hrm::PatchOrder& order,
                const model::hrm::PatchEnvironment& environment, Clock clock, const parallel::GoesOn& goes_on = {});

struct MapErrors {
  // [m] maximum distance between a mark's positions in the two maps; NaN: no mark is visible in both maps.
  double position_m = 0.0;
  double shadow_percent = 0.0;  // [%] pixels that are dark in one map only
  // [dB] RMS ratio of powers, over pixels that are dark in neither map and exceed the noise in the ruler. NaN: there is
  // no such pixel, or the compared map is by the algorithm of 1996.
  double power_db = 0.0;
  double gray_levels = 0.0;    // [0 to 255] RMS difference of the video
  double brightness_db = 0.0;  // mean power of all pixels over that of the ruler; NaN: the algorithm of 1996
};

// Compares each pixel of the ruler with the pixel of `found` that contains its centre.
MapErrors errors_against(const MapObservation& ruler, const MapObservation& found);

}  // namespace yars::tools::trade

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
  double gray_levels = 0.0;    // [0 to 255] RMS difference of the video
  double brightness_db = 0.0;  // mean power of all samples over that of the ruler; NaN: the algorithm of 1996
};

// Compares each sample of the ruler with the sample of `found` that contains its middle, in the same sweep.
// Requires scans of the same scene, with equal numbers of sweeps.
Errors errors_against(const Ruler& ruler, const ScanObservation& found);

}  // namespace yars::tools::trade
