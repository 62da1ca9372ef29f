#include "model/kernel/traffic_points.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "lib/radar/limits.hpp"
#include "model/kernel/sweep_record.hpp"

namespace yars::model::kernel {

std::vector<rbm::MovingPoint> points_of(const databuffer::Traffic& traffic) {
  const geo::Duration since = sim_time_of(traffic.tick * radar::kTickNanoseconds);
  const auto count = std::min<std::size_t>(traffic.count, databuffer::kMostTraffic);
  std::vector<rbm::MovingPoint> points;
  points.reserve(count);
  for (const databuffer::TrafficEntity& entity : std::span(traffic.entities).first(count)) {
    const auto heading = geo::Bearing::radians(std::atan2(entity.velocity_east_mps, entity.velocity_north_mps));
    points.push_back({geo::GeodesicRay({entity.latitude_deg, entity.longitude_deg}, heading),
                      std::hypot(entity.velocity_north_mps, entity.velocity_east_mps), entity.cross_section_m2,
                      entity.height_m, since});
  }
  return points;
}

}  // namespace yars::model::kernel
