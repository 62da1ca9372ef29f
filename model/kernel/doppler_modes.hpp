// Doppler modes: Doppler beam sharpening (DBS) of the HRM PPI, and the Doppler velocity update (PVU, IPVU).
// Inputs: configuration, radar command, pose, ticks.
// Outputs: antenna sector, resolution cells; beam directions; velocity north, east, down [m/s].
// Errors: none. A velocity update that the gimbal cannot reach measures nothing.
// Threads: pure functions; one DopplerVelocityUpdate per kernel. No allocation after construction.
// Source: docs/spec/pilots_interface.md#rule-2, #rule-3, #rule-16; docs/spec/physics.md#hrm-resolution.
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

// HRM PPI: a sector scan with Doppler beam sharpening. FULL takes 18 s, other widths in proportion. The range has 480
// cells. Azimuth resolution depends on the squint. The blind zone about the ground track has no return.

// Sections of a configuration that the Doppler modes read. Holds references.
struct DopplerParameters {
  // Converts from a structure with these sections, as radar::RadarConfiguration.
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
  std::uint64_t seed;  // of all noise
};

// Ticks per sweep of the sector; at least 1.
int ticks_per_dbs_sweep(const DopplerParameters& parameters);

// Sector of a DBS scan: FULL about the ground track; HALF and QTR centred on the cursor, limited to within FULL.
antenna::Sector dbs_sector(const databuffer::RadarCommand& command, const Pose& pose,
                           const DopplerParameters& parameters);

// Azimuth resolution cell of a wedge. All wedges in a cell have the same return. Cells are counted from the ground
// track. Where cells are narrower than wedges, the wedge is the cell.
struct DbsCell {
  geo::Bearing middle;
  geo::Angle width;
};
DbsCell dbs_cell(geo::Bearing left, geo::Bearing right, const Pose& pose, const DopplerParameters& parameters);

// Elevation from the aircraft to a point on the ground; a NaN elevation of the ground counts as sea level. Flat earth.
geo::Angle elevation_to(const Pose& pose, geo::GeoPoint target, double ground_m);

// Doppler velocity update (PVU, IPVU): a round of beams, and the velocity over ground from a complete round.
// Each beam measures the speed along its line of sight with Gaussian noise. Least squares give the velocity.
// Acceleration during the round is assumed known: all speeds are those at its end.
// PVU repeats rounds. IPVU starts one per period. A round outside the gimbal limits is cancelled.
// Source: docs/spec/pilots_interface.md#rule-16.
class DopplerVelocityUpdate {
 public:
  explicit DopplerVelocityUpdate(const DopplerParameters& parameters);

  void resume(const databuffer::ModelStatus& status);
  void describe(databuffer::ModelStatus& status) const;

  // Evaluates the tick's command: PVU requests the dish always, IPVU once a period, SNIFF never.
  void read_command(const databuffer::ModelTick& tick);
  // True while a round needs the dish.
  bool needs_dish() const { return needs_dish_; }
  // Cancels the round, for example when the dish is used otherwise. The next step begins a new round.
  void cancel();

  struct Direction {
    geo::Bearing azimuth;
    geo::Angle elevation;
  };
  // Direction of the current beam, or of the first beam between rounds.
  Direction direction(const antenna::Platform& platform) const {
    return direction_of(beam_ > 0 ? beam_ - 1U : 0U, platform);
  }
  // Advances the round by one tick. `arrived`: the dish points at the beam. `within_gimbal`: the gimbal reaches the
  // beam. Measures at the end of a round.
  void step(const databuffer::ModelTick& tick, const Pose& pose, bool arrived, bool within_gimbal);

 private:
  std::size_t beams() const;
  Direction direction_of(std::size_t beam, const antenna::Platform& platform) const;
  void measure(const Pose& pose);
  void end(const databuffer::ModelTick& tick);

  DopplerParameters parameters_;
  double beam_noise_mps_;
  std::uint32_t dwell_ticks_;
  std::int64_t period_ticks_;
  geo::Vector3 measured_mps_;   // north, east, down
  std::int64_t due_tick_ = -1;  // IPVU: tick of the next round; -1: none
  std::uint32_t count_ = 0;     // number of measurements
  std::uint32_t dwell_ = 0;     // ticks on the current beam
  std::uint8_t beam_ = 0;       // number of the current beam from 1; 0: no round
  bool needs_dish_ = false;
};

}  // namespace yars::model::kernel
