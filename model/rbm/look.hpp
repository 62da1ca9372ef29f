// What one sweep of the real beam map looks at, and the three sweeps that the azimuth smear joins.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/geo/height.hpp"
#include "lib/geo/quantity.hpp"
#include "model/rbm/ray_share.hpp"

namespace yars::model::rbm {

// Every value finite, latitude within +-90 degrees, range > 0: the kernel sees to it.
struct Look {
  geo::GeoPoint apex;
  geo::AltitudeMsl altitude;
  geo::Bearing azimuth;  // of the beam's centre, true
  geo::Angle elevation;  // of the antenna, against the horizon
  geo::Length range;     // far end of the last sample
  geo::Duration sim_time{};
  std::uint8_t band = 0;     // 0..4: A..E
  std::uint8_t channel = 1;  // 1..8
  RayShare share{};          // of points
  // How far the highest and the lowest bar of the scan lie above and below the antenna's elevation; 0 with one bar.
  geo::Angle bars_above{};
  geo::Angle bars_below{};
};

// Names the noise of a sweep: equal numbers, equal noise.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t scan = 0;
  std::uint32_t sweep = 0;
};

// Power of a sweep and its two neighbours in time, each as long as the video; the first and the last sweep of a
// scan stand in for the neighbour that they lack.
struct PowerWindow {
  std::span<const float> before;
  std::span<const float> centre;
  std::span<const float> after;
  double jamming = 0.0;  // received by the centre one, at every range; full scale = 1
};

// Weights over three sweeps; their sum is 1, so that power is conserved. Source: the 1996 report.
inline constexpr std::array<double, 3> kAzimuthWeights{0.25, 0.5, 0.25};

}  // namespace yars::model::rbm
