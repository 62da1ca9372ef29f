// Visibility of a patch map by ray casting with Embree 3, in packets of sixteen rays. One ray per pixel from above
// finds the highest surface; a second ray to the radar finds whether it is lit. Without Embree this is not built.
#pragma once

#include <memory>

#include "model/hrm/patch_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::benchmarks {

class Visibility {
 public:
  Visibility();
  ~Visibility();
  Visibility(const Visibility&) = delete;
  Visibility& operator=(const Visibility&) = delete;

  // Thread CPU seconds of the tree; 0: there is no Embree.
  double build(const model::hrm::PatchOrder& order, const model::scene::SceneView& scene, double elevation_m, int size);
  void cast();
  double lit() const;  // share of the pixels of the last cast

 private:
  struct Rays;
  std::unique_ptr<Rays> rays_;
};

}  // namespace yars::benchmarks
