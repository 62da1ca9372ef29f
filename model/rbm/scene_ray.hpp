// Ray of a sweep in the coordinates of polygonal scenes, and which scenes it meets.
// Inputs: apex, azimuth and range of the ray; a scene.
// Outputs: vectors in the scene's frame; whether the scene lies within the range, and under the ray.
// Frames: earth-centred, earth-fixed; east-north-up of a scene [m].
// Accuracy: double precision. A geodesic differs by less than 1 km from the vertical plane through its start.
#pragma once

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::rbm {

class SceneRay {
 public:
  explicit SceneRay(const physics::SweepGeometry& geometry);

  // The ray in a scene's frame: the apex on the ellipsoid, and horizontal unit vectors at the apex.
  struct InScene {
    geo::Vector3 apex, ahead, right, north, east;
  };
  InScene in(const scene::Scatterers& scene) const;

  // False if no part of a scene is within the range.
  bool reaches(const scene::Scatterers& scene) const;
  // True if the ray passes over a scene, or at most 1 km beside it.
  bool crosses(const scene::Scatterers& scene) const;

 private:
  geo::Vector3 apex_, ahead_, right_, north_, east_;
  double range_m_;
};

}  // namespace yars::model::rbm
