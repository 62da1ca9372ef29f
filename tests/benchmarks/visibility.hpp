// Visibility of a patch map by ray casting with Embree 3, in packets of sixteen rays. A vertical ray per pixel finds
// the highest surface. A second ray, from that surface to the radar, finds whether the surface is lit. Without Embree
// build() returns 0 and cast() does nothing.
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

  // Makes the rays' scene: the triangles near the map, and level ground at `elevation_m`. `size`: [pixels] side of the
  // map. Returns the thread CPU time [s] of Embree's search tree; 0: no Embree.
  double build(const model::hrm::PatchOrder& order, const model::scene::SceneView& scene, double elevation_m, int size);
  void cast();         // casts the rays of all pixels
  double lit() const;  // fraction of pixels that the last cast() found lit, [0, 1]

 private:
  struct Rays;
  std::unique_ptr<Rays> rays_;
};

}  // namespace yars::benchmarks
