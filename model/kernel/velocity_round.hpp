// PVU and IPVU: when the dish leaves its scan for a round of beams, where each points, and the velocity over ground
// that a whole round measures. Each beam gives the Doppler speed along its line of sight with noise of its own, least
// squares make a velocity of them; what the aircraft accelerates between the beams counts as known, so all speeds are
// those at the end of the round. A round that the gimbal cannot fly measures nothing. Pure: one call a tick, no
// allocation after construction. Source: docs/spec/pilots_interface.md#rule-16.
#pragma once

#include <cstdint>

#include "databuffer/records/model_records.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/velocity_beams.hpp"
#include "model/kernel/pose.hpp"

namespace yars::model::kernel {

class VelocityRound {
 public:
  explicit VelocityRound(const radar::RadarConfiguration& configuration);

  void resume(const databuffer::ModelStatus& status);
  void describe(databuffer::ModelStatus& status) const;

  // Looks at what a tick commands: PVU measures all the time, IPVU once a period, SNIFF never.
  void follow(const databuffer::ModelTick& tick);
  // True while the dish is wanted for it.
  bool wanted() const { return wanted_; }
  // The dish was not to be had: the round begins anew when it is.
  void give_up();

  struct Direction {
    geo::Bearing azimuth;
    geo::Angle elevation;
  };
  // Of the beam under way, or of the first.
  Direction direction(const antenna::Platform& platform) const {
    return direction_of(beam_ > 0 ? beam_ - 1U : 0U, platform);
  }
  // A tick for which the dish was there, or not yet; `within_gimbal`: whether it can be. Measures at the end of a
  // round.
  void step(const databuffer::ModelTick& tick, const Pose& pose, bool arrived, bool within_gimbal);

 private:
  std::size_t beams() const { return configuration_->navigation.beam_azimuths_deg.size(); }
  Direction direction_of(std::size_t beam, const antenna::Platform& platform) const;
  void measure(const Pose& pose);
  void end(const databuffer::ModelTick& tick);

  const radar::RadarConfiguration* configuration_;
  double beam_noise_mps_;
  std::uint32_t dwell_ticks_;
  std::int64_t period_ticks_;
  geo::Vector3 measured_mps_;   // north, east, down
  std::int64_t due_tick_ = -1;  // IPVU: of the next round; -1 = none
  std::uint32_t count_ = 0;     // measurements
  std::uint32_t dwell_ = 0;     // ticks that the beam under way has stood
  std::uint8_t beam_ = 0;       // 1, 2, ... on the way or standing; 0 = none
  bool wanted_ = false;
};

}  // namespace yars::model::kernel
