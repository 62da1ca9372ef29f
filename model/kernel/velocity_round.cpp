#include "model/kernel/velocity_round.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "lib/failure/require.hpp"
#include "lib/radar/chance.hpp"
#include "lib/radar/limits.hpp"
#include "lib/radar/modes.hpp"

namespace yars::model::kernel {

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

bool lets_interleave(std::uint8_t mode) {
  return mode <= static_cast<std::uint8_t>(Mode::beacon);  // RBM, HRM PPI, patch, BCN
}

}  // namespace

VelocityRound::VelocityRound(const radar::RadarConfiguration& configuration)
    : configuration_(&configuration),
      // The noise that is configured is the solution's; a beam has what the geometry makes of it.
      beam_noise_mps_(configuration.navigation.velocity_noise_mps /
                      radar::horizontal_dilution(configuration.navigation).value_or(1.0)),
      dwell_ticks_(static_cast<std::uint32_t>(ticks_of(configuration.navigation.beam_dwell_s))),
      period_ticks_(ticks_of(configuration.navigation.velocity_period_s)) {
  YARS_REQUIRE(configuration.navigation.beam_depressions_deg.size(), ==, beams());
  YARS_REQUIRE(beams(), >=, radar::kLeastVelocityBeams);
  YARS_REQUIRE(beams(), <=, radar::kMostVelocityBeams);
}

void VelocityRound::resume(const ModelStatus& status) {
  const Vector3 measured{status.velocity_north_mps, status.velocity_east_mps, status.velocity_down_mps};
  measured_mps_ = is_finite(measured) ? measured : Vector3{};
  due_tick_ = status.velocity_due_tick;
  count_ = status.velocity_count;
  beam_ = status.velocity_beam <= beams() ? status.velocity_beam : std::uint8_t{0};
  dwell_ = beam_ > 0 ? std::min(status.velocity_dwell, dwell_ticks_) : 0U;
}

void VelocityRound::describe(ModelStatus& status) const {
  status.velocity_north_mps = measured_mps_.x;
  status.velocity_east_mps = measured_mps_.y;
  status.velocity_down_mps = measured_mps_.z;
  status.velocity_due_tick = due_tick_;
  status.velocity_count = count_;
  status.velocity_dwell = dwell_;
  status.velocity_beam = beam_;
}

void VelocityRound::follow(const ModelTick& tick) {
  const databuffer::RadarCommand& command = tick.command;
  if ((command.flags & databuffer::kIpvu) == 0U) {
    due_tick_ = -1;
  } else if (due_tick_ < 0 || due_tick_ - period_ticks_ > tick.tick) {
    // Just selected, or the ticks began anew.
    due_tick_ = tick.tick;
  }
  const bool interleaves = due_tick_ >= 0 && tick.tick >= due_tick_ && lets_interleave(command.mode);
  wanted_ = transmits(command) && (command.mode == static_cast<std::uint8_t>(Mode::pvu) || interleaves);
  if (!wanted_) give_up();
}

void VelocityRound::give_up() {
  beam_ = 0;
  dwell_ = 0;
}

VelocityRound::Direction VelocityRound::direction_of(std::size_t beam, const antenna::Platform& platform) const {
  const radar::NavigationConfiguration& navigation = configuration_->navigation;
  return {
      antenna::scan_centre(platform, configuration_->antenna) + geo::Angle::degrees(navigation.beam_azimuths_deg[beam]),
      geo::Angle::degrees(-navigation.beam_depressions_deg[beam])};
}

void VelocityRound::step(const ModelTick& tick, const Pose& pose, bool arrived, bool within_gimbal) {
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

void VelocityRound::end(const ModelTick& tick) {
  give_up();
  if (due_tick_ >= 0) due_tick_ = tick.tick + period_ticks_;
  follow(tick);
}

void VelocityRound::measure(const Pose& pose) {
  std::array<Vector3, radar::kMostVelocityBeams> lines;
  std::array<double, radar::kMostVelocityBeams> speeds_mps{};
  for (std::size_t i = 0; i < beams(); ++i) {
    const Direction beam = direction_of(i, pose.platform);
    lines[i] = radar::line_of_sight(beam.azimuth, beam.elevation);
    speeds_mps[i] =
        dot(lines[i], pose.velocity_mps) + beam_noise_mps_ * radar::standard_normal(configuration_->seed, count_, i);
  }
  const auto velocity_mps = radar::velocity_of({lines.data(), beams()}, {speeds_mps.data(), beams()});
  if (!velocity_mps) return;
  measured_mps_ = *velocity_mps;
  ++count_;
}

}  // namespace yars::model::kernel
