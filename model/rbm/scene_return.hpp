// Return of polygonal scenes in a sweep of the real beam map.
// A standing object has the cross section sigma: the sum over its faces of gamma times the area projected towards the
// radar. It returns at its own range and bearing. Only its part above the horizon of nearer ground is lit. Covers are
// flat faces on the ground, such as runways and roads. They replace the ground's return in proportion to the area that
// they cover.
// Inputs: sweep geometry, receiver, scenes, the sweep's ground with its horizon and power.
// Outputs: the power of the samples before the pulse smear, changed in place.
// Accuracy: double precision; the algorithms `reference` and `standard` both use this class. Cross sections of
// `standard` are in float (scene_simd.hpp), and the ground between its samples is straight where nothing stands out.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/spec/physics.md#power, docs/radar_maths.md#scenes.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/scene_simd.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::rbm {

class SceneReturn {
 public:
  SceneReturn(const physics::RadarParameters& parameters, std::size_t samples);

  // Samples of the sweep, near to far, before scenes are added.
  struct Ground {
    explicit Ground(std::size_t samples)
        : distance_m(samples), height_m(samples), cross_slope(samples), horizon(samples), power(samples) {
      peak_m.reserve(samples);
      straight.reserve(samples);
    }
    std::vector<double> distance_m;   // over ground, ascending; NaN: slant range too short to meet the ground
    std::vector<double> height_m;     // [m MSL]; NaN: void
    std::vector<double> cross_slope;  // slope across the sweep
    std::vector<double> horizon;      // maximum tangent of elevation angle up to and including this sample
    std::vector<double> power;        // before the pulse smear
    // Algorithm `standard`: highest ground at the sample [m MSL], which casts the shadow; NaN: void.
    std::vector<double> peak_m;
    // 1: the ground between the previous sample and this one is taken to be straight. 0, or empty: it is walked.
    std::vector<std::uint8_t> straight;
  };

  // Prepares a sweep. If a scene is within range, returns true; the caller then fills ground() and calls apply().
  bool enter(const physics::SweepGeometry& geometry, const scene::SceneView* scenes);
  // True if a standing part of a scene may lie within the range and within point_interval(). Replaces what enter() has
  // prepared.
  bool has_standing(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                    const scene::SceneView* scenes);
  Ground& ground() { return ground_; }
  // Applies the scenes to ground().power. `pulse_samples`: length of the pulse smear that the caller applies later.
  void apply(const physics::SweepGeometry& geometry, const physics::Receiver& receiver, const physics::GroundWalk& walk,
             const scene::SceneView& scenes, double pulse_samples);

 private:
  // Ray in a scene's east-north-up frame [m]: the apex on the ellipsoid, and horizontal unit vectors at the apex.
  struct Ray {
    geo::Vector3 apex, ahead, right, north, east;
  };
  // A scatterer as seen from one apex. It does not depend on the beam's azimuth, so the sweeps of a scan share it.
  struct Echo {
    std::uint64_t key = 0;     // number of the view (view_) and of the scatterer; 0: none
    double azimuth_rad = 0.0;  // true azimuth at the apex, in (-pi, pi]
    double distance_m = 0.0;   // over ground
    double tangent = 0.0;      // of the elevation angle of the scatterer's middle
    std::size_t nearer = 0;    // about how many samples are nearer
    double power = 0.0;        // received in the middle of the beam's azimuth, without shadow; below 0: not yet known
  };
  // What the echoes of a view have in common.
  struct View {
    geo::GeoPoint apex;
    geo::AltitudeMsl altitude;
    geo::Length range;
    geo::Angle elevation;
    const scene::SceneView* scenes = nullptr;
    std::uint64_t generation = 0;  // of `scenes`

    bool operator==(const View&) const = default;
  };
  // Quantities of one sweep that all scenes share.
  struct Sweep {
    const physics::SweepGeometry* geometry = nullptr;
    const physics::Receiver* receiver = nullptr;
    const physics::EffectiveEarth* earth = nullptr;
    const physics::GroundWalk* walk = nullptr;
    double point_smear_gain = 1.0;  // physics::point_smear_gain() of the pulse
    double spacing_m = 0.0;         // range between samples
    double azimuth_rad = 0.0;       // of the beam, in [-pi, pi]
  };
  Ray ray_in(const scene::Scatterers& scene) const;
  bool in_range(const scene::Scatterers& scene, const physics::SweepGeometry& geometry) const;
  bool under_ray(const scene::Scatterers& scene) const;
  void cover_ground(const Sweep& sweep, const scene::Scatterers& scene);
  double covered_power(const Sweep& sweep, std::size_t sample, double gamma) const;
  template <class Visit>
  void visit_standing(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                      const scene::Scatterers& scene, const scene::ScattererLevel& level, const Visit& visit) const;
  void add_standing(const Sweep& sweep, const scene::Scatterers& scene);
  void add_scatterer(const Sweep& sweep, const Ray& ray, const scene::ScattererLevel& level, std::uint32_t index);
  Echo find(const Sweep& sweep, const Ray& ray, const scene::Scatterer& scatterer, std::uint64_t key) const;
  double power_of(const Sweep& sweep, const Ray& ray, const scene::ScattererLevel& level,
                  const scene::Scatterer& scatterer, const Echo& echo) const;
  double cross_section_m2(const scene::ScattererLevel& level, const scene::Scatterer& scatterer, const Ray& ray,
                          const physics::Sight& sight) const;
  double horizon_before(const Sweep& sweep, const scene::Scatterer& scatterer, const Echo& echo) const;
  double lit_fraction(const Sweep& sweep, const scene::Scatterer& scatterer, const Echo& echo) const;
  void spread(const Echo& echo, double extent_m, double power);

  simd::SceneTables tables_;
  std::uint64_t view_number_ = 0;
  std::uint64_t scatterers_before_ = 0;  // in the scenes before the present one
  physics::GeometryParameters parameters_;
  physics::GasPath gas_;
  geo::Vector3 apex_, ahead_, right_, north_, east_;  // earth-centred, earth-fixed
  std::vector<Echo> echoes_;                          // by number of the scatterer, modulo their size
  View view_;
  physics::SceneSurface surface_;
  Ground ground_;
  radar::BeamPattern beam_;
  bool fast_;  // cross sections in vectors; `reference` uses double precision
};

}  // namespace yars::model::rbm
