// What polygonal scenes make of a sweep: what stands returns sigma = sum of gamma times the area that faces the radar,
// at its range and bearing, lit as far as it rises above the ground's horizon; what covers the ground is seen instead
// of the ground. Plain double, one function for all algorithms. No allocation after construction; with no scene in
// view enter() is all that it costs. Source: docs/spec/physics.md#power; docs/radar_maths.md#scenes.
#pragma once

#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::rbm {

class SceneReturn {
 public:
  SceneReturn(const radar::RadarConfiguration& configuration, std::size_t samples);

  // The sweep as the ground alone makes it, near to far.
  struct Ground {
    explicit Ground(std::size_t samples)
        : distance_m(samples), height_m(samples), cross_slope(samples), horizon(samples), power(samples) {}
    std::vector<double> distance_m;   // over ground, ascending, NaN first
    std::vector<double> height_m;     // MSL; NaN = void
    std::vector<double> cross_slope;  // across the sweep
    std::vector<double> horizon;      // greatest tangent up to here, this one included
    std::vector<double> power;        // before the pulse smear
  };

  // True if a scene comes within range: then ground() is to be filled, and apply() changes its power.
  bool enter(const physics::SweepGeometry& look, const scene::SceneView* scenes);
  Ground& ground() { return ground_; }
  // `pulse_samples`: of the smear that comes behind it.
  void apply(const physics::SweepGeometry& look, const physics::Receiver& receiver, const physics::GroundWalk& walk,
             const scene::SceneView& scenes, double pulse_samples);

 private:
  // The ray in a scene's frame: the aircraft's place on the ellipsoid, and unit vectors level at it.
  struct Ray {
    geo::Vector3 apex, ahead, right;
  };
  // What changes from sweep to sweep but not from scene to scene.
  struct Sweep {
    const physics::SweepGeometry* look = nullptr;
    const physics::Receiver* receiver = nullptr;
    const physics::EffectiveEarth* earth = nullptr;
    const physics::GroundWalk* walk = nullptr;
    double rise = 1.0;        // of a point, for the smear
    double curvature2 = 0.0;  // [1/m^2] of the ellipsoid along the ray
    double spacing_m = 0.0;   // of samples
  };
  Ray ray_in(const scene::Scatterers& scene) const;
  bool in_range(const scene::Scatterers& scene, const physics::SweepGeometry& look) const;
  bool under_ray(const scene::Scatterers& scene) const;
  void cover_ground(const Sweep& sweep, const scene::Scatterers& scene);
  double covered_power(const Sweep& sweep, std::size_t sample, double gamma) const;
  void add_standing(const Sweep& sweep, const scene::Scatterers& scene);
  void add_one(const Sweep& sweep, const Ray& ray, const scene::ScattererLevel& level, const scene::Scatterer& one);
  double cross_section_m2(const scene::ScattererLevel& level, const scene::Scatterer& one, const Ray& ray,
                          const physics::Sight& sight) const;
  double lit_share(const Sweep& sweep, const scene::Scatterer& one, const physics::Sight& sight,
                   double distance_m) const;
  void spread(double distance_m, double extent_m, double power);

  radar::BeamPattern beam_;
  physics::SceneSurface surface_;
  physics::GasPath gas_;
  Ground ground_;
  geo::Vector3 apex_, ahead_, right_;  // earth-centred
};

}  // namespace yars::model::rbm
