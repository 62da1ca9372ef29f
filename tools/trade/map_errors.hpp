// Errors of a patch map against the ruler, with marks on the ground that show where it puts things.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::tools::trade {

// Bright squares painted on the ground of a map's window, some pixels wide: their places in the picture tell how far a
// fidelity puts things from where another does. The ground carries them, so they are laid over as the terrain is.
inline constexpr int kMarksAnEdge = 3;

class MarkScene final : public model::scene::SceneView {
 public:
  // Evenly over the window, kMarksAnEdge an edge, three hundredths of it wide.
  explicit MarkScene(const model::hrm::PatchOrder& order);

  std::uint64_t generation() const override { return 1; }
  std::uint64_t resident_bytes() const override { return 0; }
  const std::vector<model::scene::SurfaceKind>& kinds() const override { return kinds_; }
  const std::vector<model::scene::SceneObject>& objects() const override { return objects_; }
  void tiles_near(geo::GeoPoint place, double radius_m, std::vector<const model::scene::Tile*>& found) const override;
  void objects_near(geo::GeoPoint place, double radius_m, std::vector<std::uint32_t>& found) const override;

 private:
  void add(geo::GeoPoint place, double edge_m);

  std::vector<model::scene::Tile> tiles_;
  std::vector<model::scene::SurfaceKind> kinds_;
  std::vector<model::scene::SceneObject> objects_;
};

// The same radar where nothing but the marks returns: no detail, no response, no movers.
radar::RadarConfiguration marks_alone(radar::RadarConfiguration configuration);

// What one fidelity makes of one map, and how far that is from the ruler. Everything without noise, speckle and the
// random numbers of 1996: they are no error, and the ruler draws others. A comparison goes over the ruler's pixels:
// each takes the pixel that its middle lies in.
struct MapEvidence {
  int size = 0;                                            // [pixels] on an edge
  std::vector<float> power;                                // gamma of level ground; of 1996: brightness
  std::vector<std::uint8_t> dark;                          // 1: returns less than a twentieth of level ground
  std::vector<std::uint8_t> video;                         // as drawn
  std::vector<std::optional<model::hrm::MapPoint>> marks;  // where those marks appear; none: hidden
  bool power_is_radar = true;                              // false: brightness of 1996
  double noise = 0.0;                                      // thermal noise, as gamma of level ground
  double took_ms = 0.0;                                    // [ms] of the thread's processor time, by the clock given
};

// Processor time of the thread [ms]; the caller has the clock.
using Clock = double (*)();

MapEvidence observe_map(const radar::RadarConfiguration& configuration, const model::hrm::PatchOrder& order,
                        const model::hrm::PatchEnvironment& database, Clock clock);

// One map from the order to its video, noise as configured; [ms].
double time_map(model::hrm::PatchFormation& process, const model::hrm::PatchOrder& order,
                const model::hrm::PatchEnvironment& database, Clock clock);

struct MapErrors {
  double position_m = 0.0;      // [m] farthest that a mark lies from the ruler's; NaN: the ruler sees none
  double shadow_percent = 0.0;  // [%] of the pixels that one has dark and the other has not
  double power_db = 0.0;        // [dB] RMS where neither is dark and the ruler's stands above the noise; NaN: nowhere
  double gray_levels = 0.0;     // RMS of the video, of 255
};

MapErrors errors_against(const MapEvidence& ruler, const MapEvidence& found);

}  // namespace yars::tools::trade
