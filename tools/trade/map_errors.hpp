// Errors of a patch map against the ruler, the map of the reference algorithm. Position errors are measured with marks:
// bright squares on the ground (no relation to the cursor function MARK).
// Units: metres, percent of pixels, dB RMS, gray levels RMS; times are thread CPU time [ms].
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

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
  double gray_levels = 0.0;  // [0 to 255] RMS difference of the video
};

// Compares each pixel of the ruler with the pixel of `found` that contains its centre.
MapErrors errors_against(const MapObservation& ruler, const MapObservation& found);

}  // namespace yars::tools::trade
