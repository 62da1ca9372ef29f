#include "model/kernel/tick_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "databuffer/messages/derived_values.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/modes.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::kernel {

namespace {
constexpr double kMinAltitude_m = -1000.0;  // limits of the ownship's altitude above mean sea level
constexpr double kMaxAltitude_m = 200000.0;
// 18.5 m. The inverse of a denormal range would be infinite as a float.
constexpr double kMinRange_nm = 0.01;
constexpr double kMaxRange_nm = 1000.0;  // at longer ranges the series of the earth's curvature lose accuracy
}  // namespace

std::optional<Pose> pose_of(const databuffer::Ownship& ownship) {
  const std::array<double, 9> values{ownship.latitude_deg,       ownship.longitude_deg,     ownship.altitude_msl_m,
                                     ownship.heading_deg,        ownship.pitch_deg,         ownship.roll_deg,
                                     ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps};
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return {};
  if (std::abs(ownship.latitude_deg) > 90.0 || std::abs(ownship.longitude_deg) > 180.0) return {};
  if (ownship.altitude_msl_m < kMinAltitude_m || ownship.altitude_msl_m > kMaxAltitude_m) return {};
  Pose pose;
  pose.position = {ownship.latitude_deg, ownship.longitude_deg};
  pose.altitude = geo::AltitudeMsl::metres(ownship.altitude_msl_m);
  pose.platform = databuffer::platform_of(ownship);
  pose.ground_speed = geo::Speed::metres_per_second(std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps));
  pose.velocity_mps = {ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps};
  return pose;
}

radar::MapViewpoint viewpoint_of(const Pose& pose) {
  return {pose.position, pose.altitude, pose.platform};
}

bool requests_scan(const databuffer::RadarCommand& command) {
  const bool scans = command.mode == static_cast<std::uint8_t>(radar::Mode::rbm) ||
                     command.mode == static_cast<std::uint8_t>(radar::Mode::hrm) ||
                     command.mode == static_cast<std::uint8_t>(radar::Mode::beacon);
  return command.power == static_cast<std::uint8_t>(radar::Power::operate) && scans &&
         command.range_nm >= kMinRange_nm && command.range_nm <= kMaxRange_nm;
}

namespace {
constexpr std::uint64_t kTrafficNumbers = 1ULL << 32U;  // PointTarget::number of traffic is beyond those of movers
}  // namespace

std::vector<physics::MovingPoint> points_of(const databuffer::Traffic& traffic) {
  const geo::Duration start = sim_time_of(traffic.tick * radar::kTickNanoseconds);
  const auto count = std::min<std::size_t>(traffic.count, databuffer::kMaxTraffic);
  std::vector<physics::MovingPoint> points;
  points.reserve(count);
  for (const databuffer::TrafficEntity& entity : std::span(traffic.entities).first(count)) {
    const auto heading = geo::Bearing::radians(std::atan2(entity.velocity_east_mps, entity.velocity_north_mps));
    points.push_back(physics::moving_point(
        {{entity.latitude_deg, entity.longitude_deg},
         heading,
         std::hypot(entity.velocity_north_mps, entity.velocity_east_mps),
         start},
        {.cross_section_m2 = entity.cross_section_m2, .number = kTrafficNumbers + entity.id}, entity.height_m));
  }
  return points;
}

int scan_detail(const radar::Fidelity& fidelity, geo::Length range) {
  if (!(fidelity.posts_per_sample > 0.0)) return 0;
  const int samples = std::clamp(fidelity.samples, 1, radar::kMaxSamples);
  return terrain::detail_for(range.metres() / samples / fidelity.posts_per_sample);
}

namespace {
// A finer preset is selected if its expected load is below this fraction of the core share. The margin keeps two
// presets from alternating at small changes of the load.
constexpr double kUpgradeMargin = 0.7;
constexpr int kMaxAge_scans = 120;  // scans after which a measured load is outdated (two minutes of 1 s scans)
}  // namespace

double FidelityGovernor::expected_load(std::size_t index, double load) const {
  const Measurement& measurement = measurements_[index];
  if (measurement.known && measurement.scans_ago < kMaxAge_scans) return measurement.load;
  return load * kLadder[index].cost_over_lower;
}

void FidelityGovernor::record_load(double load) {
  if (!std::isfinite(load)) return;
  for (Measurement& measurement : measurements_) ++measurement.scans_ago;
  measurements_[preset_index_] = {load, 0, true};
  if (load > core_share_) {
    if (preset_index_ > 0) --preset_index_;
    return;
  }
  if (preset_index_ + 1 < kLadder.size() && expected_load(preset_index_ + 1, load) < kUpgradeMargin * core_share_)
    ++preset_index_;
}

}  // namespace yars::model::kernel
