#include "model/kernel/doppler_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/radar/velocity_beams.hpp"
#include "lib/random/counter_rng.hpp"

namespace yars::model::kernel {

namespace {
// Width of FULL, the widest scan. A scan of this width takes sector_time_s.
double full_width_deg(const DopplerParameters& parameters) {
  const std::vector<double>& widths = parameters.scan_widths_deg;
  return *std::max_element(widths.begin(), widths.end());
}
// Ratio of `sector_time_s` to the time in which the antenna crosses the sector. The turn-around takes a tenth of the
// crossing time (kTurnFraction of antenna.cpp).
constexpr double kTurnFactor = 1.1;

// Antenna rate of a DBS scan.
double sector_rate_dps(const DopplerParameters& parameters) {
  return kTurnFactor * full_width_deg(parameters) / parameters.high_resolution.sector_time_s;
}
}  // namespace

int ticks_per_dbs_sweep(const DopplerParameters& parameters) {
  const double degrees_per_tick = sector_rate_dps(parameters) * radar::kTickSeconds;
  return std::max(1, static_cast<int>(std::lround(parameters.high_resolution.sector_step_deg / degrees_per_tick)));
}

antenna::Sector dbs_sector(const databuffer::RadarCommand& command, const Pose& pose,
                           const DopplerParameters& parameters) {
  antenna::Sector sector;
  sector.width_deg = command.scan_width_deg;
  sector.rate_dps = sector_rate_dps(parameters);
  const geo::GeoPoint cursor{command.cursor_latitude_deg, command.cursor_longitude_deg};
  const bool known = (command.flags & databuffer::kCursorValid) != 0U && std::isfinite(cursor.latitude_deg) &&
                     std::isfinite(cursor.longitude_deg);
  const double max_offset_deg = 0.5 * (full_width_deg(parameters) - sector.width_deg);
  if (!known || !(max_offset_deg > 0.0)) return sector;
  const geo::Bearing middle = antenna::scan_centre(pose.platform, parameters.antenna);
  const geo::Angle off = geo::geodesic_inverse(pose.position, cursor).azimuth_at_start - middle;
  sector.offset_deg = std::clamp(off.degrees(), -max_offset_deg, max_offset_deg);
  return sector;
}

DbsCell dbs_cell(geo::Bearing left, geo::Bearing right, const Pose& pose, const DopplerParameters& parameters) {
  const geo::Angle width = right - left;
  const geo::Bearing azimuth = left + 0.5 * width;
  const geo::Angle squint = azimuth - pose.platform.ground_track;
  const double cell_deg = radar::dbs_beamwidth(squint, pose.ground_speed, parameters).degrees();
  if (cell_deg <= parameters.high_resolution.sector_step_deg) return {azimuth, width};
  const double middle_deg = (std::floor(squint.degrees() / cell_deg) + 0.5) * cell_deg;
  return {pose.platform.ground_track + geo::Angle::degrees(middle_deg), geo::Angle::degrees(cell_deg)};
}

geo::Angle elevation_to(const Pose& pose, geo::GeoPoint target, double ground_m) {
  const geo::Length distance = geo::geodesic_inverse(pose.position, target).distance;
  return radar::elevation_to_ground(pose.altitude, distance, ground_m);
}

using databuffer::ModelStatus;
using databuffer::ModelTick;
using geo::Vector3;
using radar::Mode;

namespace {

std::int64_t ticks_of(double seconds) {
  return std::max<std::int64_t>(1, std::llround(seconds / radar::kTickSeconds));
}

bool is_finite(Vector3 vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

bool transmits(const databuffer::RadarCommand& command) {
  return command.power == static_cast<std::uint8_t>(radar::Power::operate) &&
         (command.flags & databuffer::kSniff) == 0U;
}

bool allows_interleaved_update(std::uint8_t mode) {
  return mode <= static_cast<std::uint8_t>(Mode::beacon);  // the modes RBM, HRM PPI, patch and BCN
}

}  // namespace

DopplerVelocityUpdate::DopplerVelocityUpdate(const DopplerParameters& parameters)
    : parameters_(parameters),
      // The configured standard deviation applies to a horizontal component of the measured velocity. The standard
      // deviation of a beam's speed follows from it and the beam directions.
      beam_noise_mps_(parameters.navigation.velocity_noise_mps /
                      radar::horizontal_dilution(parameters.navigation.beam_azimuths_deg,
                                                 parameters.navigation.beam_depressions_deg)
                          .value_or(1.0)),
      dwell_ticks_(static_cast<std::uint32_t>(ticks_of(parameters.navigation.beam_dwell_s))),
      period_ticks_(ticks_of(parameters.navigation.velocity_period_s)) {
  YARS_REQUIRE(parameters.navigation.beam_depressions_deg.size(), ==, beams());
  YARS_REQUIRE(beams(), >=, radar::kMinVelocityBeams);
  YARS_REQUIRE(beams(), <=, radar::kMaxVelocityBeams);
}

void DopplerVelocityUpdate::resume(const ModelStatus& status) {
  const Vector3 measured{status.velocity_north_mps, status.velocity_east_mps, status.velocity_down_mps};
  measured_mps_ = is_finite(measured) ? measured : Vector3{};
  due_tick_ = status.velocity_due_tick;
  count_ = status.velocity_count;
  beam_ = status.velocity_beam <= beams() ? status.velocity_beam : std::uint8_t{0};
  dwell_ = beam_ > 0 ? std::min(status.velocity_dwell, dwell_ticks_) : 0U;
}

void DopplerVelocityUpdate::describe(ModelStatus& status) const {
  status.velocity_north_mps = measured_mps_.x;
  status.velocity_east_mps = measured_mps_.y;
  status.velocity_down_mps = measured_mps_.z;
  status.velocity_due_tick = due_tick_;
  status.velocity_count = count_;
  status.velocity_dwell = dwell_;
  status.velocity_beam = beam_;
}

void DopplerVelocityUpdate::read_command(const ModelTick& tick) {
  const databuffer::RadarCommand& command = tick.command;
  if ((command.flags & databuffer::kIpvu) == 0U) {
    due_tick_ = -1;
  } else if (due_tick_ < 0 || due_tick_ - period_ticks_ > tick.tick) {
    // IPVU has just been selected, or the tick count was reset.
    due_tick_ = tick.tick;
  }
  const bool interleaves = due_tick_ >= 0 && tick.tick >= due_tick_ && allows_interleaved_update(command.mode);
  needs_dish_ = transmits(command) && (command.mode == static_cast<std::uint8_t>(Mode::pvu) || interleaves);
  if (!needs_dish_) cancel();
}

void DopplerVelocityUpdate::cancel() {
  beam_ = 0;
  dwell_ = 0;
}

std::size_t DopplerVelocityUpdate::beams() const {
  return parameters_.navigation.beam_azimuths_deg.size();
}

DopplerVelocityUpdate::Direction DopplerVelocityUpdate::direction_of(std::size_t beam,
                                                                     const radar::Platform& platform) const {
  const radar::NavigationConfiguration& navigation = parameters_.navigation;
  return {antenna::scan_centre(platform, parameters_.antenna) + geo::Angle::degrees(navigation.beam_azimuths_deg[beam]),
          geo::Angle::degrees(-navigation.beam_depressions_deg[beam])};
}

void DopplerVelocityUpdate::step(const ModelTick& tick, const Pose& pose, bool arrived, bool within_gimbal) {
  if (!within_gimbal) return end(tick);
  if (beam_ == 0) beam_ = 1;
  if (arrived) ++dwell_;
  if (dwell_ < dwell_ticks_) return;
  dwell_ = 0;
  ++beam_;
  if (beam_ <= beams()) return;
  measure(pose);
  end(tick);
}

void DopplerVelocityUpdate::end(const ModelTick& tick) {
  cancel();
  // The next round is due a whole number of periods after the last one was due. Neither the wait for the end of a scan
  // nor the length of the round adds to the period.
  if (due_tick_ >= 0 && tick.tick >= due_tick_)
    due_tick_ += ((tick.tick - due_tick_) / period_ticks_ + 1) * period_ticks_;
  read_command(tick);
}

void DopplerVelocityUpdate::measure(const Pose& pose) {
  std::array<Vector3, radar::kMaxVelocityBeams> lines;
  std::array<double, radar::kMaxVelocityBeams> speeds_mps{};
  for (std::size_t i = 0; i < beams(); ++i) {
    const Direction beam = direction_of(i, pose.platform);
    lines[i] = radar::line_of_sight(beam.azimuth, beam.elevation);
    speeds_mps[i] =
        dot(lines[i], pose.velocity_mps) + beam_noise_mps_ * random::standard_normal(parameters_.seed, count_, i);
  }
  const auto velocity_mps = radar::velocity_of({lines.data(), beams()}, {speeds_mps.data(), beams()});
  if (!velocity_mps) return;
  measured_mps_ = *velocity_mps;
  ++count_;
}

}  // namespace yars::model::kernel
