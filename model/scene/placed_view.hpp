// The view that a store gives: placed scenes, found by their places, then tiles and objects within each.
#pragma once

#include "model/scene/placing.hpp"
#include "model/scene/scene_view.hpp"

namespace yars::model::scene {

class PlacedView final : public SceneView {
 public:
  struct Part {
    std::shared_ptr<const PlacedScene> scene;
    std::uint32_t first_object = 0;
  };

  PlacedView(std::uint64_t generation, std::vector<Part> parts, std::vector<SurfaceKind> kinds,
             std::vector<SceneObject> objects);

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return bytes_; }
  const std::vector<SurfaceKind>& kinds() const override { return kinds_; }
  const std::vector<SceneObject>& objects() const override { return objects_; }
  void tiles_near(geo::GeoPoint place, double radius_m, std::vector<const Tile*>& found) const override;
  void objects_near(geo::GeoPoint place, double radius_m, std::vector<std::uint32_t>& found) const override;
  std::span<const Scatterers* const> scatterers() const override { return scatterers_; }

 private:
  std::uint64_t generation_;
  std::vector<Part> parts_;
  GridIndex places_;
  std::vector<SurfaceKind> kinds_;
  std::vector<SceneObject> objects_;
  std::vector<const Scatterers*> scatterers_;
  std::uint64_t bytes_ = 0;
};

}  // namespace yars::model::scene
