#include "model/rbm/moving_point.hpp"

namespace yars::model::rbm {

std::vector<MovingPoint> configured_points(const radar::RadarConfiguration& configuration) {
  std::vector<MovingPoint> points;
  for (const radar::Mover& mover : configuration.world.movers)
    points.push_back({geo::GeodesicRay(mover.place, geo::Bearing::degrees(mover.heading_deg)),
                      mover.speed_mps,
                      mover.cross_section_m2,
                      mover.height_m,
                      {}});
  return points;
}

}  // namespace yars::model::rbm
