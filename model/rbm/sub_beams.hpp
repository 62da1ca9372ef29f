// Algorithm that measures several rays across the beam in azimuth (sub-beams), and the factory of algorithms.
// Source: docs/spec/physics.md#sampling.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/sweep_simd.hpp"

namespace yars::model::rbm {

inline constexpr double kSubBeamsWidth = 1.5;  // [beamwidths] outside it the two-way gain is below 5 % of the maximum

// Algorithm for ground that changes within the beamwidth. Its power is the weighted sum of the powers of several rays
// across the beam. Weights follow the two-way pattern and sum to 1, so uniform ground has the power of a single ray.
//
// The rays lie at fixed true azimuths, so the beams of successive sweeps of a pass share rays. A ray is measured in the
// sweep in which the beam reaches it, and kept. It is measured again when the aircraft has moved by more than half a
// sample, after kRayLifetime, and when antenna elevation or range have changed. So a sweep depends on the earlier
// sweeps of its pass, but for a hovering aircraft on its own geometry alone.
//
// Kept rays have no point targets, because a point's gain depends on the sweep's azimuth. Where points lie in the beam,
// about kPointRays rays at most are measured with them for this sweep alone.
class SubBeams : public Algorithm {
 public:
  // With a longer one, sweeps are longer not ready after terrain was loaded, and rays older in flight. A beam of 2.5
  // degrees passes a ray in 35 ms at 110 degrees a second.
  static constexpr geo::Duration kRayLifetime = geo::Duration::seconds(0.05);
  static constexpr int kPointRays = 5;

  SubBeams(std::unique_ptr<Algorithm> ray, const physics::RadarParameters& parameters);

  void begin_pass() override;
  geo::Duration memory() const override { return kRayLifetime; }
  std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  bool has_points(const physics::SweepGeometry& geometry, const physics::Environment& environment) override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

 private:
  struct Ray {
    int number = -1;       // true azimuth divided by the spacing of rays; -1: none
    bool current = false;  // power, lit and pending are those of the ray without points, measured for `geometry`
    physics::SweepGeometry geometry;
    std::size_t pending = 0;                  // result of Algorithm::measure()
    memory::CacheAlignedVector<float> power;  // simd::kPad entries more than samples
    std::vector<std::uint8_t> lit;
  };
  // A ray of the last sweep's beam.
  struct Member {
    Ray* ray;
    double offset_rad;  // from the beam's centre, clockwise positive
    double weight;      // the sum over all members is 1
  };
  void set_beam(geo::Bearing azimuth);
  Ray& ray_of(int number, int first, int last);
  bool is_current(const Ray& ray, const physics::SweepGeometry& geometry) const;
  physics::BeamSlice slice_of(std::size_t member) const;
  void measure_ray(Ray& ray, const physics::SweepGeometry& geometry, const physics::Environment& environment);
  void measure_member(std::size_t member, const physics::SweepGeometry& geometry,
                      const physics::Environment& environment, bool points_in_beam);

  std::unique_ptr<Algorithm> ray_;
  double beamwidth_deg_;
  int circle_;                   // number of rays around the horizon
  std::size_t point_stride_;     // one of so many rays is measured with points
  std::vector<Ray> rays_;        // kept
  std::vector<Ray> point_rays_;  // with points, of the last sweep
  std::vector<Member> beam_;     // from left to right
  std::vector<simd::WeightedRay> weighted_;
};

// Makes the algorithm that the fidelity names, wrapped in SubBeams if the fidelity has more than one sub-beam.
std::unique_ptr<Algorithm> make_algorithm(const physics::RadarParameters& parameters);

}  // namespace yars::model::rbm
