// Algorithm that measures several rays across the beam in azimuth (sub-beams), and the factory of algorithms.
// Source: docs/spec/physics.md#sampling.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/rbm/algorithm.hpp"

namespace yars::model::rbm {

// Algorithm for ground that changes within the beamwidth. Its power is the weighted sum of the powers of several rays
// across the beam. Weights follow the two-way pattern and sum to 1, so uniform ground has the power of a single ray.
class SubBeams : public Algorithm {
 public:
  SubBeams(std::unique_ptr<Algorithm> ray, const physics::RadarParameters& parameters);

  std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

 private:
  struct Ray {
    geo::Angle offset;         // azimuth from the beam's centre, clockwise positive
    float weight;              // the sum over all rays is 1
    physics::BeamSlice slice;  // azimuths at which this ray collects point targets
  };
  std::unique_ptr<Algorithm> ray_;
  std::vector<Ray> rays_;
  std::vector<float> power_;
  std::vector<std::uint8_t> lit_;  // lit mask of the middle ray; of two middle rays, the right one
};

// Makes the algorithm that the fidelity names, wrapped in SubBeams if the fidelity has more than one sub-beam.
std::unique_ptr<Algorithm> make_algorithm(const physics::RadarParameters& parameters);

}  // namespace yars::model::rbm
