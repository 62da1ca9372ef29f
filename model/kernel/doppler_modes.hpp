// Doppler modes: scan with Doppler beam sharpening (DBS; mode HRM PPI), and measurement of the aircraft's velocity by
// Doppler beams (velocity update; modes PVU, IPVU).
// Inputs: configuration, radar command, pose (position, attitude and velocity of the aircraft), ticks.
// Outputs: antenna sector, resolution cells; beam directions; velocity north, east, down [m/s].
// Errors: a velocity update with a beam outside the gimbal limits measures nothing.
// Threads: one thread at a time may use a DopplerVelocityUpdate. No allocation after construction.
// Source: docs/pilots_manual.md#rule-2, #rule-3, #rule-16; docs/spec/physics.md#hrm-resolution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "databuffer/messages/model_records.hpp"
#include "lib/geo/frames.hpp"
#include "model/antenna/antenna.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::radar {
struct AntennaConfiguration;
struct HighResolutionConfiguration;
struct NavigationConfiguration;
struct ReceiverConfiguration;
}  // namespace yars::radar

namespace yars::model::kernel {

// Sections of a configuration that the Doppler modes read. Keeps references to them.
struct DopplerParameters {
  // Converts from a structure with these sections, such as radar::RadarConfiguration.
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.navigation; }
  DopplerParameters(const Configuration& whole)
      : scan_widths_deg(whole.scan_widths_deg),
        antenna(whole.antenna),
        receiver(whole.receiver),
        high_resolution(whole.high_resolution),
        navigation(whole.navigation),
        seed(whole.seed) {}

  const std::vector<double>& scan_widths_deg;  // [deg] FULL, HALF, QTR
  const radar::AntennaConfiguration& antenna;
  const radar::ReceiverConfiguration& receiver;
  const radar::HighResolutionConfiguration& high_resolution;
  const radar::NavigationConfiguration& navigation;
  std::uint64_t seed;  // key of the random measurement noise
};

// Number of ticks per sweep of a DBS scan, at least 1.
int ticks_per_dbs_sweep(const DopplerParameters& parameters);

// Sector of a DBS scan. FULL, the widest, is centred on antenna::scan_centre(), the ground track within a limit off the
// nose. HALF and QTR are centred on the cursor, but stay within FULL. Without a valid cursor they are centred like
// FULL.
antenna::Sector dbs_sector(const databuffer::RadarCommand& command, const Pose& pose,
                           const DopplerParameters& parameters);

// Azimuth resolution cell that contains the middle of a wedge. Its width is radar::dbs_beamwidth() at the squint of
// that middle. Cell boundaries are at multiples of this width from the ground track. If the width is at most the
// configured `sector_step_deg`, the wedge itself is the cell.
struct DbsCell {
  geo::Bearing middle;
  geo::Angle width;
};
DbsCell dbs_cell(geo::Bearing left, geo::Bearing right, const Pose& pose, const DopplerParameters& parameters);

// Elevation angle from the aircraft to a point on the ground, positive above the horizontal, on a flat earth.
// `ground_m`: elevation of the point [m MSL]; NaN counts as sea level.
geo::Angle elevation_to(const Pose& pose, geo::GeoPoint target, double ground_m);

// Doppler velocity update (PVU, IPVU): a round of beams, and the velocity over ground from a complete round.
// Each beam measures the speed along its line of sight, positive toward the ground, with Gaussian noise. Least squares
// give the velocity.
// A real radar knows the acceleration during a round from the aircraft's sensors and refers all speeds to the round's
// end. The model therefore computes all speeds from the velocity at that time.
// PVU repeats rounds. IPVU interleaves one round per period with scans. A beam outside the gimbal limits cancels the
// round.
class DopplerVelocityUpdate {
 public:
  explicit DopplerVelocityUpdate(const DopplerParameters& parameters);

  void resume(const databuffer::ModelStatus& status);
  void describe(databuffer::ModelStatus& status) const;

  // Evaluates the tick's command. While the radar transmits (power switch at OPR, no SNIFF), PVU always requests the
  // dish. IPVU requests it once a period in the modes RBM, HRM PPI, patch and BCN. Without a request the round is
  // cancelled.
  void read_command(const databuffer::ModelTick& tick);
  bool needs_dish() const { return needs_dish_; }
  // Cancels the round, for example when a map needs the dish. The next call of step() begins a new round.
  void cancel();

  struct Direction {
    geo::Bearing azimuth;
    geo::Angle elevation;  // positive above the horizontal
  };
  // Direction of the current beam. Between rounds: direction of the first beam.
  Direction direction(const radar::Platform& platform) const {
    return direction_of(beam_ > 0 ? beam_ - 1U : 0U, platform);
  }
  // Advances the round by one tick. `arrived`: the dish points along the beam. `within_gimbal`: false if the dish
  // cannot point there; the round then ends without a measurement. Measures after the last beam of a round.
  void step(const databuffer::ModelTick& tick, const Pose& pose, bool arrived, bool within_gimbal);

 private:
  std::size_t beams() const;
  Direction direction_of(std::size_t beam, const radar::Platform& platform) const;
  void measure(const Pose& pose);
  void end(const databuffer::ModelTick& tick);

  DopplerParameters parameters_;
  double beam_noise_mps_;
  std::uint32_t dwell_ticks_;
  std::int64_t period_ticks_;
  geo::Vector3 measured_mps_;   // north, east, down
  std::int64_t due_tick_ = -1;  // IPVU: tick of the next round; -1: none
  std::uint32_t count_ = 0;     // number of measurements
  std::uint32_t dwell_ = 0;     // ticks for which the dish has pointed along the current beam
  std::uint8_t beam_ = 0;       // number of the current beam from 1; 0: no round
  bool needs_dish_ = false;
};

}  // namespace yars::model::kernel
