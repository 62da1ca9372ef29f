// Inside of the radar kernel: what it remembers from tick to tick, and how it scans.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/radar/modes.hpp"
#include "model/antenna/antenna.hpp"
#include "model/kernel/doppler_modes.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/physics/environment.hpp"

namespace yars::model::kernel {

using databuffer::ModelStatus;
using databuffer::ModelTick;

// SNIFF transmits nothing, and BCN hears no ground: to them it matters only where it hides a jammer or a beacon.
inline bool needs_ground(std::uint8_t mode, bool silent, const radar::RadarConfiguration& configuration) {
  if (!configuration.world.jamming.jammers.empty()) return true;
  const bool beacons_alone = mode == static_cast<std::uint8_t>(radar::Mode::beacon);
  return !silent && (!beacons_alone || !configuration.world.beacons.beacons.empty());
}

inline bool sniffs(const databuffer::RadarCommand& command) {
  return (command.flags & databuffer::kSniff) != 0U;
}

inline bool frozen_by(const databuffer::RadarCommand& command) {
  return (command.flags & databuffer::kFreeze) != 0U;
}

struct ScanState {
  explicit ScanState(const radar::RadarConfiguration& given)
      : configuration(given),
        sharpened(dbs_configuration(given)),
        antenna(given.antenna),
        beam_chain(given),
        dbs_chain(sharpened),
        maps(configuration),
        velocity(configuration) {}
  ScanState(const ScanState&) = delete;
  ScanState& operator=(const ScanState&) = delete;
  ~ScanState() = default;

  bool is_dbs() const { return command.mode == static_cast<std::uint8_t>(radar::Mode::hrm); }
  SweepChain& chain() { return is_dbs() ? dbs_chain : beam_chain; }
  void clear_chains();

  bool follow_command(const ModelTick& tick, databuffer::Sweep& sweep);
  void use_samples(std::uint32_t samples);
  void use_fidelity(const ModelTick& tick);
  double wanted_width_deg(const databuffer::RadarCommand& command) const;
  void restart(const databuffer::RadarCommand& command);
  void step_maps(const ModelTick& tick, const terrain::TerrainView& terrain);
  void stop_scanning();
  void point_unless_scanning(const ModelTick& tick, const terrain::TerrainView& terrain);
  geo::Angle wanted_elevation(const terrain::TerrainView& terrain) const;
  bool gather(const ModelTick& tick, const antenna::AntennaStep& step, const physics::Environment& database,
              databuffer::Sweep& sweep);
  void start_scan(const databuffer::RadarCommand& command);
  bool sweep_tick(const ModelTick& tick, const antenna::AntennaStep& step, const physics::Environment& database,
                  databuffer::Sweep& sweep);
  void remember(ModelStatus& status) const;

  radar::RadarConfiguration configuration;
  radar::RadarConfiguration sharpened;  // for the HRM PPI
  antenna::Antenna antenna;
  SweepChain beam_chain;
  SweepChain dbs_chain;
  MapSchedule maps;
  DopplerVelocityUpdate velocity;
  antenna::AntennaStep gathered;  // of a sharpened sweep: what its ticks swept so far
  int gathered_ticks = 0;
  std::optional<Pose> pose;  // the last good one
  databuffer::RadarCommand command{};
  std::int64_t tick = 0;
  std::int64_t sim_time_ns = 0;
  double scan_width_deg = 0.0;  // of the scan under way
  double scan_range_m = 0.0;
  std::uint32_t epoch = 0;
  std::uint32_t scan = 0;
  std::uint32_t next_sweep = 0;
  std::uint32_t scan_restart = 0;  // the last one obeyed
  bool started = false;            // has seen a tick, or a predecessor's status
  bool scanning = false;
  bool frozen = false;
  bool noise_only = false;  // SNIFF, for the scan under way
  bool pose_fresh = false;
};

}  // namespace yars::model::kernel
