// The visibility task of a patch by ray casting: from above a ray a pixel finds the highest surface, from there a ray
// to the radar finds whether it is lit. Packets of sixteen rays of Embree 3; without Embree nothing is built.
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
