// State of the radar kernel between ticks, and its scan logic: power switch, mode, freeze, restart, antenna, sweeps.
// Inputs: one ModelTick per step; terrain, scenes and traffic.
// Outputs: Sweep records; fields of ModelStatus.
// Threads: one at a time. Internal to the kernel.
// Source: docs/pilots_manual.md#rule-2, #rule-8, #rule-9, #rule-18.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lib/radar/configuration.hpp"
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

// Configuration with which the algorithms of the real beam map compute a scan with Doppler beam sharpening (DBS): 480
// samples, pulse at most one range cell, one ray per sweep, no azimuth smear.
radar::RadarConfiguration dbs_configuration(const radar::RadarConfiguration& configuration);

// True if a sweep needs terrain. In SNIFF (receive only, `silent`) and in BCN (beacons only) there is no ground return.
// Terrain is then needed only for lines of sight: to jammers, and to beacons unless `silent`.
inline bool needs_ground(std::uint8_t mode, bool silent, const radar::RadarConfiguration& configuration) {
  if (!configuration.world.jamming.jammers.empty()) return true;
  const bool beacons_alone = mode == static_cast<std::uint8_t>(radar::Mode::beacon);
  return !silent && (!beacons_alone || !configuration.world.beacons.beacons.empty());
}

// SNIFF: receive only.
inline bool sniffs(const databuffer::RadarCommand& command) {
  return (command.flags & databuffer::kSniff) != 0U;
}

inline bool frozen_by(const databuffer::RadarCommand& command) {
  return (command.flags & databuffer::kFreeze) != 0U;
}

// All values that persist from tick to tick, and the steps that change them.
struct ScanState {
  explicit ScanState(const radar::RadarConfiguration& initial)
      : configuration(initial),
        configured_fidelity(initial.fidelity),
        dbs_settings(dbs_configuration(initial)),
        antenna(initial.antenna),
        beam_chain(initial),
        dbs_chain(dbs_settings),
        maps(configuration),
        velocity(configuration) {}
  ScanState(const ScanState&) = delete;
  ScanState& operator=(const ScanState&) = delete;
  ~ScanState() = default;

  bool is_dbs() const { return command.mode == static_cast<std::uint8_t>(radar::Mode::hrm); }
  SweepChain& chain() { return is_dbs() ? dbs_chain : beam_chain; }
  void clear_chains();

  // Starts, restarts or stops the scan as commanded. Returns true if freeze or a velocity update stops the scan while
  // its last sweep is unfinished. That sweep is then finished and written to `sweep`.
  bool follow_command(const ModelTick& tick, databuffer::Sweep& sweep);
  // Uses another world from the next sweep on. The scan goes on; a sweep that is not finished keeps its power.
  void use_world(const radar::WorldConfiguration& world);
  void use_samples(std::uint32_t samples);
  // Applies the preset of that name: at the start of a scan, and to resume one. An unknown name changes nothing.
  void use_fidelity(std::string_view name);
  double commanded_width_deg(const databuffer::RadarCommand& command) const;
  void restart(const databuffer::RadarCommand& command);
  void step_maps(const ModelTick& tick, const terrain::TerrainView& terrain);
  void stop_scanning();
  void point_unless_scanning(const ModelTick& tick, const terrain::TerrainView& terrain);
  geo::Angle commanded_elevation(const terrain::TerrainView& terrain) const;
  bool accumulate(const ModelTick& tick, const antenna::AntennaStep& step, const physics::Environment& environment,
                  databuffer::Sweep& sweep);
  void start_scan(const databuffer::RadarCommand& command);
  bool sweep_tick(const ModelTick& tick, const antenna::AntennaStep& step, const physics::Environment& environment,
                  databuffer::Sweep& sweep);
  void write_status(ModelStatus& status) const;

  radar::RadarConfiguration configuration;
  radar::Fidelity configured_fidelity;     // that of `configuration` changes with the ticks
  radar::RadarConfiguration dbs_settings;  // from dbs_configuration()
  antenna::Antenna antenna;
  SweepChain beam_chain;
  SweepChain dbs_chain;
  MapSchedule maps;
  DopplerVelocityUpdate velocity;
  antenna::AntennaStep accumulated;  // wedges of the current DBS sweep, joined so far
  int accumulated_ticks = 0;         // number of these wedges
  std::optional<Pose> pose;          // last valid pose
  databuffer::RadarCommand command{};
  std::int64_t tick = 0;
  std::int64_t sim_time_ns = 0;
  double scan_width_deg = 0.0;  // width of the current scan
  double scan_range_m = 0.0;
  std::uint32_t epoch = 0;
  std::uint32_t scan = 0;          // number of the current scan
  std::uint32_t next_sweep = 0;    // number of the next sweep
  std::uint32_t scan_restart = 0;  // last applied RadarCommand::scan_restart
  bool started = false;            // a tick with a known pose, or a status to resume from, has been received
  bool scanning = false;
  bool frozen = false;
  bool noise_only = false;  // the current scan is in SNIFF (receive only)
  bool pose_fresh = false;  // this tick has a valid ownship
};

}  // namespace yars::model::kernel
