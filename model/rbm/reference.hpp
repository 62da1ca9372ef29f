// Reference algorithm of the real beam map: double precision, a walk over all ground of the ray (physics::GroundWalk)
// on the exact geodesic, whatever the number of samples. Tests and `yars trade` compare the faster algorithms with it.
// tests/truth compares it with numbers from outside.
// Accuracy: double precision; power is returned as float (6e-8 relative).
// Source: docs/radar_maths.md.
#pragma once

#include <limits>
#include <vector>

#include "lib/radar/fidelity.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/scene_ray.hpp"

namespace yars::model::rbm {

class Reference : public Algorithm {
 public:
  explicit Reference(const physics::RadarParameters& parameters);

  void use_weather(const physics::RadarParameters& parameters) override;
  std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  bool has_points() const override { return true; }
  void describe(RayGround& ground) const override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

  // Intermediate results of the last measure() for one sample; read by tests.
  struct Sample {
    double distance_m = 0.0;  // over ground
    geo::GeoPoint position;
    geo::Bearing azimuth;       // direction of the ray at the position
    double height_m = 0.0;      // [m MSL] ground that returns power; NaN: void
    double peak_m = 0.0;        // [m MSL] ground that casts the shadow: terrain::Surface::peak_m; NaN: void
    double water = 0.0;         // fraction of water [0, 1]
    std::uint8_t material = 0;  // surface material code
    double horizon = 0.0;       // maximum tangent of elevation angle of all ground up to and including this sample
    bool lit = false;
    double transmission = 1.0;     // two-way, of the rain
    double power = 0.0;            // of all ground of the sample's cell, full scale = 1, before the pulse smear
    double power_per_gamma = 0.0;  // what it would be if all of it were land with gamma 1
  };
  std::span<const Sample> samples() const { return samples_; }

 private:
  // Bins of a cell. Within a bin power is taken as even, which bounds the error of the pulse smear.
  static constexpr std::size_t kBinsOfCell = 32;
  static constexpr double kBins = kBinsOfCell;
  // Ground of the walk up to one of its positions.
  struct Front {
    double distance_m = 0.0;
    double height_m = 0.0;  // as Sample::height_m
    double tangent = 0.0;   // of the ground at the position; NaN: void
    double horizon = 0.0;   // maximum tangent up to the position
  };
  // The last edge of a shadow. NaN: none that diffracts rays to the ground beyond.
  struct Edge {
    double tangent = 0.0, distance_m = 0.0;
  };
  static constexpr Edge kNoEdge{std::numeric_limits<double>::quiet_NaN(), 0.0};
  // What is equal for all ground of a sample's cell.
  struct Cell {
    std::size_t number;
    double from_m, to_m;  // over ground
    double gas;           // two-way transmission
  };
  std::size_t read_terrain(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);
  void walk_ground(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                   const physics::GroundWalk& walk);
  Cell cell_of(std::size_t number) const;
  double parameter_at(double tangent, double distance_m, double wavelength_m) const;
  void follow_edge(const Front& from, const Front& to, double wavelength_m);
  void add_ground(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                  const physics::EffectiveEarth& earth, const Cell& cell, const Front& from, const Front& to,
                  const physics::GroundWalk::Point& point);
  void add_covers(const physics::SweepGeometry& geometry, const scene::SceneView& scenes);
  void add_rain(const physics::Receiver& receiver, const physics::EffectiveEarth& earth,
                const physics::SweepGeometry& geometry);
  void average_slant_ranges(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth);
  void move_to_slant_range(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth);
  void smear_pulse(double pulse_samples, std::span<float> power);

  radar::Fidelity fidelity_;
  physics::GeometryParameters geometry_parameters_;
  physics::Receivers receivers_;
  physics::SurfaceReturn surface_;
  physics::RainPath rain_;
  physics::GasPath gas_;
  SceneCovers scene_covers_;
  std::vector<Sample> samples_;
  Edge edge_ = kNoEdge;
  std::vector<double> bins_;  // power, kBinsOfCell of each sample, in the unit of Sample::power
  // Mean slant range of the return of each bin [m], and bins by slant range.
  std::vector<double> slant_m_, moved_bins_;
  std::vector<double> weights_;  // of the pulse smear
  std::vector<double> distance_m_;
  std::vector<double> steady_;  // power of point targets by sample of the video
};

}  // namespace yars::model::rbm
