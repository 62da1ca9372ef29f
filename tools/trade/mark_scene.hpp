// Bright squares painted on the ground of a map's window, some pixels wide: their places in the picture tell how far a
// fidelity puts things from where another does. The ground carries them, so they are laid over as the terrain is.
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/scene/scene_view.hpp"

namespace yars::tools::trade {

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

}  // namespace yars::tools::trade
