// Beam of the real beam map: the ground of one ray or of several rays across the beam in azimuth (sub-beams), and point
// targets.
// Inputs: geometry of a sweep; terrain, scenes and traffic; configuration at construction.
// Outputs: power per sample, mask of the lit samples, 8-bit video, as of Algorithm.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/spec/physics.md#sampling.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/point_return.hpp"
#include "model/rbm/sweep_simd.hpp"

namespace yars::radar {
struct WorldChanges;
}  // namespace yars::radar

namespace yars::model::rbm {

inline constexpr double kSubBeamsWidth = 1.5;  // [beamwidths] outside it the two-way gain is below 5 % of the maximum

// With one sub-beam, each sweep has a ray in the middle of its beam.
//
// Several are for ground that changes within the beamwidth. The power is then the weighted sum of the powers of the
// rays. Weights follow the two-way pattern and sum to 1, so uniform ground has the power of a single ray. The rays lie
// at fixed true azimuths, so the beams of successive sweeps of a pass share rays. A ray is measured in the sweep in
// which the beam reaches it, and kept. It is measured again when the aircraft has moved by more than half a sample,
// after kRayLifetime, and when antenna elevation or range have changed. So a sweep depends on the earlier sweeps of its
// pass, but for a hovering aircraft on its own geometry alone.
//
// The power of point targets follows from each sweep's own azimuth and is added to the sum.
class Beam {
 public:
  // With a longer one, sweeps are longer not ready after terrain was loaded, and rays older in flight. A beam of 2.5
  // degrees passes a ray in 35 ms at 110 degrees a second.
  static constexpr geo::Duration kRayLifetime = geo::Duration::seconds(0.05);

  explicit Beam(const physics::RadarParameters& parameters);
  // The same with an algorithm of the caller's.
  Beam(std::unique_ptr<Algorithm> algorithm, const physics::RadarParameters& parameters);

  // Uses the changed parts of another world, which `parameters` has, from the next measure() on. A change of sea or
  // rain measures the rays of the next beam again: kept ones have the power of the world before.
  void use_world(const physics::RadarParameters& parameters, const radar::WorldChanges& changes);
  // Discards the rays that are kept. Call it before the first sweep of a pass (one crossing of the scan width).
  void begin_pass();
  // Longest time for which what a sweep leaves serves later sweeps.
  geo::Duration memory() const { return rays_.size() > 1 ? kRayLifetime : geo::Duration(); }

  // As Algorithm::measure(), with point targets. Returns the sum over the rays.
  std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                      std::span<float> power);
  // PowerWindow::steady of the last sweep that was measured.
  std::span<const physics::SteadyPower> steady() const { return steady_; }
  // Number of rays measured since the start of the pass.
  std::size_t rays() const { return measured_; }
  // As Algorithm::lit(), of the ray nearest the beam's centre.
  void lit(std::span<std::uint8_t> mask) const;
  // PowerWindow::automatic_gain_db of a sweep with returns of ground.
  double automatic_gain_db(const physics::SweepGeometry& geometry);
  // PowerWindow::looks of a sweep.
  int looks(const physics::SweepGeometry& geometry, geo::Speed ground_speed, geo::Bearing ground_track);
  // As Algorithm::form_video().
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) {
    algorithm_->form_video(window, range, gain, key, video);
  }

 private:
  struct Ray {
    explicit Ray(std::size_t samples) : power(samples + simd::kPad), lit(samples), ground(samples) {}
    int number = -1;                          // true azimuth divided by the spacing of rays; -1: none
    bool current = false;                     // measured for ground.geometry
    bool described = false;                   // all of `ground` is
    std::size_t pending = 0;                  // result of Algorithm::measure()
    memory::CacheAlignedVector<float> power;  // simd::kPad entries more than samples
    std::vector<std::uint8_t> lit;
    RayGround ground;
  };
  // A ray of the last sweep's beam.
  struct Member {
    Ray* ray;
    double offset;  // [beamwidths] from the beam's centre, clockwise positive
    double weight;  // the sum over all members is 1
  };
  void set_beam(geo::Bearing azimuth);
  Ray& ray_of(int number, int first, int last);
  bool is_current(const Ray& ray, const physics::SweepGeometry& geometry, bool with_points) const;
  void measure_ray(Ray& ray, const physics::SweepGeometry& geometry, const physics::Environment& environment,
                   bool with_points);
  std::size_t measure_members(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                              bool with_points, std::span<float> power);

  std::optional<PointReturn> points_;
  std::unique_ptr<Algorithm> algorithm_;
  physics::Receivers receivers_;
  physics::Receiver receiver_;  // of the last selected range
  radar::BeamPattern pattern_;
  int circle_;  // number of rays around the horizon
  double beamwidth_deg_;
  std::vector<Ray> rays_;     // kept; one if there are no sub-beams
  std::vector<Member> beam_;  // from left to right
  std::vector<simd::WeightedRay> weighted_;
  std::vector<const RayGround*> grounds_;  // of beam_
  std::vector<physics::SteadyPower> steady_;
  std::size_t measured_ = 0;
};

// Makes the algorithm that the fidelity names.
std::unique_ptr<Algorithm> make_algorithm(const physics::RadarParameters& parameters);

}  // namespace yars::model::rbm
