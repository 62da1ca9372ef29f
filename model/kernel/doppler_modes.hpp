// Modes that use the Doppler shift: beam-sharpened sector scan and velocity update.
#pragma once

#include <cstdint>

#include "databuffer/messages/model_records.hpp"
#include "lib/geo/frames.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/velocity_beams.hpp"
#include "model/antenna/antenna.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::model::kernel {

// The HRM PPI: a Doppler beam sharpened sector. FULL takes 18 s, other widths in proportion; it looks ahead of and
// beside the cursor, resolves the range over 480 cells, and in azimuth as fine as the squint allows; nothing returns
// about the ground track. Source: docs/spec/pilots_interface.md#rule-2, #rule-3; docs/spec/physics.md#hrm-resolution.

// What the algorithm of the beam map works with when the beam is sharpened.
radar::RadarConfiguration dbs_configuration(const radar::RadarConfiguration& configuration);

// Ticks that one sweep of the sector gathers; at least 1.
int ticks_a_dbs_sweep(const radar::RadarConfiguration& configuration);

// FULL about the ground track; HALF and QTR centred on the cursor, as far as they stay within FULL.
antenna::Sector dbs_sector(const databuffer::RadarCommand& command, const Pose& pose,
                           const radar::RadarConfiguration& configuration);

// The resolution cell that a wedge lies in: what is seen there is one. Cells are counted from the ground track; where
// they are narrower than wedges the wedge is the cell.
struct DbsCell {
  geo::Bearing middle;
  geo::Angle width;
};
DbsCell dbs_cell(geo::Bearing left, geo::Bearing right, const Pose& pose,
                 const radar::RadarConfiguration& configuration);

// Where the dish points in HRM: down to the cursor, or to the map.
geo::Angle elevation_to(const Pose& pose, geo::GeoPoint target, double ground_m);

// PVU and IPVU: when the dish leaves its scan for a round of beams, where each points, and the velocity over ground
// that a whole round measures. Each beam gives the Doppler speed along its line of sight with noise of its own, least
// squares make a velocity of them; what the aircraft accelerates between the beams counts as known, so all speeds are
// those at the end of the round. A round that the gimbal cannot fly measures nothing. Pure: one call a tick, no
// allocation after construction. Source: docs/spec/pilots_interface.md#rule-16.
class DopplerVelocityUpdate {
 public:
  explicit DopplerVelocityUpdate(const radar::RadarConfiguration& configuration);

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
