// A ship or a vehicle as a point that goes its geodesic at a steady speed: one of the configuration from sim time 0 on,
// one of the traffic from the moment at which it was heard of.
#pragma once

#include <vector>

#include "lib/geo/geodesic.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::model::rbm {

struct MovingPoint {
  geo::GeodesicRay way;
  double speed_mps = 0.0;
  double cross_section_m2 = 0.0;
  double height_m = 0.0;  // above the ground
  geo::Duration since{};  // sim time at which it was at the begin of its way

  geo::GeoPoint place(geo::Duration sim_time) const {
    return way.position(geo::Length::metres(speed_mps * (sim_time - since).seconds()));
  }
};

std::vector<MovingPoint> configured_points(const radar::RadarConfiguration& configuration);

}  // namespace yars::model::rbm
