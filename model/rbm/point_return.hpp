// Return of point targets in a sweep of the real beam map: movers, and the standing parts of polygonal scenes.
// A standing object has the cross section sigma: the sum over its faces of gamma times the area projected towards the
// radar. It returns at its own range and bearing. Only its part above the horizon of nearer ground is lit, weighted
// between the two rays of the beam beside it. A mover is lit or hidden along its own azimuth. The nearest ray has the
// rain on the way.
// Inputs: geometry of the sweep, scenes, traffic, the ground along the beam's rays.
// Outputs: power of the targets, smeared over the pulse and added to the power of the samples, and the steady part of
// it; full scale = 1.
// Accuracy: double precision; the algorithms `reference` and `standard` both use this class. Of `standard` the cross
// sections are in float (scene_simd.hpp), echoes below a millionth of the noise are left out, and the ground between
// samples is straight where nothing stands out (RayGround::slope).
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/spec/physics.md#power, docs/radar_maths.md#scenes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/radar/modes.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/line_of_sight.hpp"
#include "model/rbm/scene_ray.hpp"
#include "model/rbm/scene_simd.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::rbm {

class PointReturn {
 public:
  explicit PointReturn(const physics::RadarParameters& parameters);
  // Replaces the configured movers.
  void use_movers(const physics::RadarParameters& parameters);
  void use_sea(const physics::RadarParameters& parameters);

  // False if there is no mover, and no scene within the range. Then add() changes nothing.
  bool may_return(const physics::SweepGeometry& geometry, const physics::Environment& environment) const;

  // Adds the power of the targets in the beam to `power`, and lists the part of movers and traffic in `steady`. `rays`:
  // ground of the beam's rays from left to right, at equal steps of azimuth. They may have been measured shortly before
  // the sweep, from another position.
  void add(const physics::SweepGeometry& geometry, const physics::Environment& environment,
           std::span<const RayGround* const> rays, std::span<float> power, std::vector<physics::SteadyPower>& steady);

 private:
  // A scatterer as seen from one apex. It does not depend on the beam's azimuth, so the sweeps of a scan share it.
  struct Echo {
    std::uint64_t key = 0;     // number of the view (view_) and of the scatterer; 0: none
    double azimuth_rad = 0.0;  // true azimuth at the apex, in (-pi, pi]
    double distance_m = 0.0;   // over ground
    double shown_m = 0.0;      // range at which it is drawn: over ground, or with `slantRange` the slant range
    double per_metre = 0.0;    // 1 / distance_m
    double tangent = 0.0;      // of the elevation angle of the scatterer's middle
    std::size_t nearer = 0;    // about how many samples are nearer
    double power = 0.0;        // received in the middle of the beam's azimuth, without shadow; below 0: not yet known
  };
  // Values that the echoes of a view share.
  struct View {
    geo::GeoPoint apex;
    geo::AltitudeMsl altitude;
    geo::Length range;
    geo::Angle elevation;
    const scene::SceneView* scenes = nullptr;
    std::uint64_t generation = 0;  // of `scenes`

    bool operator==(const View&) const = default;
  };
  // Values that all targets of one sweep share.
  struct Sweep {
    const physics::SweepGeometry& geometry;
    const physics::Environment& environment;
    const physics::Receiver& receiver;
    double point_smear_gain;  // physics::point_smear_gain() of the pulse
    double spacing_m;         // range between samples
    double azimuth_rad;       // of the beam, in [-pi, pi]
    double negligible;        // weaker echoes are left out
  };
  // A ray, and the way of the aircraft since it was measured.
  struct Shade {
    const RayGround* ground;
    double ahead_m;  // along the ray
    double climb_m;
    bool moved;  // false: both are 0
  };
  // Numbers of the two rays beside a target, and the weight of the right one.
  struct Neighbours {
    std::size_t left, right;
    double right_weight;
    std::size_t nearest() const { return right_weight < 0.5 ? left : right; }
  };
  // A scatterer's middle as seen from the aircraft.
  struct Target {
    double distance_m;
    double per_metre;  // 1 / distance_m
    double tangent;
    double height_m;  // [m MSL] of the point at that tangent
  };
  // A target as seen from the position at which a ray was measured.
  struct Seen {
    const RayGround& ground;
    Target target;
    std::size_t nearer;  // number of samples nearer than the target
    double tangent_of(double height_msl_m) const {
      return target.tangent + (height_msl_m - target.height_m) * target.per_metre;
    }
  };
  void add_movers(const Sweep& sweep);
  void add_scenes(const Sweep& sweep, const scene::SceneView& scenes);
  void add_standing(const Sweep& sweep, const SceneRay::InScene& ray, const scene::Scatterers& scene);
  void add_scatterer(const Sweep& sweep, const SceneRay::InScene& ray, const scene::ScattererLevel& level,
                     std::uint32_t index);
  Echo find(const Sweep& sweep, const SceneRay::InScene& ray, const scene::Scatterer& scatterer,
            std::uint64_t key) const;
  double power_of(const Sweep& sweep, const SceneRay::InScene& ray, const scene::ScattererLevel& level,
                  const scene::Scatterer& scatterer, const Echo& echo) const;
  double lobe_factor(const Sweep& sweep, const scene::Scatterer& scatterer, const Echo& echo,
                     const physics::EffectiveEarth& earth) const;
  double cross_section_m2(const scene::ScattererLevel& level, const scene::Scatterer& scatterer,
                          const SceneRay::InScene& ray, const physics::Sight& sight) const;
  void set_rays(const physics::SweepGeometry& geometry, std::span<const RayGround* const> rays);
  Neighbours rays_at(double offset_rad) const;
  Seen seen_by(const Shade& ray, const Target& target, std::size_t about) const;
  double horizon_before(const Sweep& sweep, const Seen& seen) const;
  double lit_fraction(const Sweep& sweep, const scene::Scatterer& scatterer, const Seen& seen) const;
  void put(const RayGround& ground, std::size_t sample, double power);
  void spread(const RayGround& ground, const Echo& echo, double extent_m, double power);
  // Adds the power that is put so far to the samples. `steady`: null, or where it is listed, too.
  void smear_into(std::span<float> power, std::vector<physics::SteadyPower>* steady);

  physics::GeometryParameters parameters_;
  radar::BeamPattern beam_;
  radar::Interpolation interpolation_;
  bool fast_;  // false: algorithm `reference`
  bool pulse_smear_;
  bool has_movers_;  // in the configuration
  physics::Receivers receivers_;
  physics::Receiver receiver_;  // of the last sweep's range
  physics::Movers movers_;
  MoverSights mover_sights_;
  physics::GasPath gas_;
  physics::SceneSurface surface_;
  simd::SceneTables tables_;
  std::vector<Echo> echoes_;  // by number of the scatterer, modulo their size
  View view_;                 // of echoes_
  std::uint64_t view_number_ = 0;
  std::uint64_t scatterers_before_ = 0;  // in the scenes before the present one
  std::vector<Shade> rays_;
  std::span<const double> distance_m_;  // of the samples, of the leftmost ray; about that of all
  double first_ray_rad_ = 0.0;          // azimuth of the leftmost ray from the middle of the beam
  double rays_per_rad_ = 0.0;           // 0: one ray
  double smeared_samples_ = -1.0;       // pulse length [samples] of smear_; -1: none
  physics::PulseSmear smear_;
  // Power by sample before the smear, and after it; 0 between the sweeps. All that is not 0 lies in [first_, end_).
  std::vector<double> points_, smeared_;
  std::size_t first_ = 0, end_ = 0;
};

}  // namespace yars::model::rbm
