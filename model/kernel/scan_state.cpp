#include "model/kernel/scan_state.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lib/radar/mission.hpp"
#include "lib/text/plain_text.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/physics/receiver.hpp"

namespace yars::model::kernel {

radar::RadarConfiguration dbs_configuration(const radar::RadarConfiguration& configuration) {
  radar::RadarConfiguration dbs_settings = configuration;
  dbs_settings.fidelity.samples = radar::kMapCells;
  // Doppler filters resolve neighbouring azimuth cells, so there is no smear between sweeps.
  dbs_settings.fidelity.azimuth_smear = false;
  dbs_settings.fidelity.sub_beams = 1;
  for (std::size_t i = 0; i < dbs_settings.pulse_us.size() && i < dbs_settings.ranges_nm.size(); ++i) {
    const double cell_m = geo::Length::nautical_miles(dbs_settings.ranges_nm[i]).metres() / radar::kMapCells;
    dbs_settings.pulse_us[i] = std::min(dbs_settings.pulse_us[i], cell_m / physics::kMetresPerMicrosecond);
  }
  return dbs_settings;
}

void ScanState::clear_chains() {
  beam_chain.clear();
  dbs_chain.clear();
  accumulated_ticks = 0;
}

void ScanState::step_maps(const ModelTick& input, const terrain::TerrainView& terrain) {
  if ((input.flags & databuffer::kTickMapComplete) != 0U && maps.forming()) maps.complete();
  const geo::GeoPoint position = maps.next_centre(input.command, *pose);
  const bool known = std::isfinite(position.latitude_deg) && std::isfinite(position.longitude_deg);
  maps.step(input, *pose, known ? terrain.elevation_m(position) : kUnknown, !velocity.needs_dish());
}

void ScanState::stop_scanning() {
  if (scanning) antenna.park();
  scanning = false;
}

// Points the dish while it does not scan. A forming map has priority over a Doppler velocity update.
void ScanState::point_unless_scanning(const ModelTick& input, const terrain::TerrainView& terrain) {
  if (scanning) return;
  const radar::Platform& platform = pose->platform;
  const bool measures = velocity.needs_dish() && !maps.forming();
  if (!measures) velocity.cancel();
  if (measures) {
    const DopplerVelocityUpdate::Direction beam = velocity.direction(platform);
    const bool arrived = antenna.point(platform, beam.azimuth, beam.elevation);
    const bool within = radar::within_gimbal(platform, configuration.antenna, beam.azimuth, beam.elevation);
    velocity.step(input, *pose, arrived, within);
  } else if (const auto target = maps.pointing_target(input, *pose)) {
    const geo::Bearing azimuth = geo::geodesic_inverse(pose->position, *target).azimuth_at_start;
    antenna.point(platform, azimuth, elevation_to(*pose, *target, terrain.elevation_m(*target)));
  } else {
    antenna.park();
  }
}

// Antenna elevation above the horizontal. In the mode HRM PPI (DBS scan) the dish points at the ground at the cursor,
// if the cursor is valid.
geo::Angle ScanState::commanded_elevation(const terrain::TerrainView& terrain) const {
  const geo::GeoPoint cursor{command.cursor_latitude_deg, command.cursor_longitude_deg};
  const bool known = (command.flags & databuffer::kCursorValid) != 0U && std::isfinite(cursor.latitude_deg) &&
                     std::isfinite(cursor.longitude_deg);
  if (!is_dbs() || !known) return geo::Angle::degrees(command.antenna_elevation_deg);
  return elevation_to(*pose, cursor, terrain.elevation_m(cursor));
}

// Joins the wedges of successive ticks into one DBS sweep (Doppler beam sharpening), from the edge at which the antenna
// enters the first wedge to the edge at which it leaves the last one.
bool ScanState::accumulate(const ModelTick& input, const antenna::AntennaStep& step,
                           const physics::Environment& environment, databuffer::Sweep& sweep) {
  if (accumulated_ticks == 0) {
    accumulated = step;
  } else {
    if (step.direction > 0) accumulated.right = step.right;
    if (step.direction < 0) accumulated.left = step.left;
    accumulated.reachable = accumulated.reachable && step.reachable;
    accumulated.scan_end = step.scan_end;
    accumulated.elevation = step.elevation;
  }
  ++accumulated_ticks;
  if (accumulated_ticks < ticks_per_dbs_sweep(configuration) && !step.scan_end) return false;
  accumulated_ticks = 0;
  return sweep_tick(input, accumulated, environment, sweep);
}

bool ScanState::follow_command(const ModelTick& input, databuffer::Sweep& sweep) {
  command = input.command;
  const bool jumped = started && input.epoch != epoch;
  epoch = input.epoch;
  started = true;
  if (jumped) velocity.cancel();
  if (!requests_scan(command)) {
    stop_scanning();
    frozen = false;
    clear_chains();
    return false;
  }
  if (maps.blocks_scanning(command)) {
    stop_scanning();
    clear_chains();
    return false;
  }
  if (frozen_by(command)) {
    // Freeze stops a scan at its end. In SNIFF (receive only) freeze stops a DBS scan at once.
    const bool silenced = is_dbs() && sniffs(command);
    if (frozen || !scanning || silenced || antenna.between_scans()) {
      stop_scanning();
      frozen = true;
      return chain().flush(sweep);
    }
  } else if (velocity.needs_dish() && (!scanning || antenna.between_scans())) {
    stop_scanning();
    frozen = false;
    return chain().flush(sweep);
  } else if (frozen || !scanning) {
    frozen = false;
    restart(command);
    return false;
  }
  if (jumped || command.scan_restart != scan_restart || commanded_width_deg(command) != scan_width_deg)
    restart(command);
  return false;
}

void ScanState::use_world(const radar::WorldConfiguration& world) {
  const radar::WorldChanges changes = radar::changes_between(configuration.world, world);
  if (!changes.any()) return;
  configuration.world = dbs_settings.world = world;
  beam_chain.use_world(configuration, changes);
  dbs_chain.use_world(dbs_settings, changes);
}

void ScanState::use_samples(std::uint32_t samples) {
  if (samples == 0 || samples == beam_chain.samples() || samples > static_cast<std::uint32_t>(radar::kMaxSamples))
    return;
  configuration.fidelity.samples = static_cast<int>(samples);
  beam_chain = SweepChain(configuration);
}

void ScanState::use_fidelity(std::string_view name) {
  if (name == configuration.fidelity.name) return;
  const auto preset =
      name == configured_fidelity.name ? std::optional(configured_fidelity) : radar::fidelity_preset(name);
  if (!preset) return;
  configuration.fidelity = *preset;
  configuration.fidelity.automatic = configured_fidelity.automatic;
  configuration.fidelity.core_share = configured_fidelity.core_share;
  beam_chain = SweepChain(configuration);
  dbs_settings = dbs_configuration(configuration);
  dbs_chain = SweepChain(dbs_settings);
}

// Replaces a width that is not finite by the current width. Otherwise NaN, which equals no number, would restart the
// scan at each tick.
double ScanState::commanded_width_deg(const databuffer::RadarCommand& request) const {
  return std::isfinite(request.scan_width_deg) ? request.scan_width_deg : scan_width_deg;
}

void ScanState::restart(const databuffer::RadarCommand& request) {
  scan_restart = request.scan_restart;
  scan_width_deg = commanded_width_deg(request);
  scanning = true;
  if (is_dbs()) {
    antenna.restart(dbs_sector(request, *pose, configuration));
  } else {
    antenna.restart(scan_width_deg);
  }
  clear_chains();
}

// Increments the scan number and latches the values that are constant during a scan.
void ScanState::start_scan(const databuffer::RadarCommand& request) {
  ++scan;
  scan_range_m = geo::Length::nautical_miles(request.range_nm).metres();
  noise_only = sniffs(request);
}

bool ScanState::sweep_tick(const ModelTick& input, const antenna::AntennaStep& step,
                           const physics::Environment& environment, databuffer::Sweep& sweep) {
  if (step.scan_start || scan_range_m <= 0.0) {
    use_fidelity(text::text_of(input.fidelity));
    start_scan(input.command);
  }
  SweepHeader header{pose->position,
                     pose->altitude,
                     step.left,
                     step.right,
                     pose->platform.ground_track,
                     step.elevation,
                     geo::Length::metres(scan_range_m),
                     step.direction,
                     sim_time_of(input.sim_time_ns),
                     input.command.band,
                     input.command.channel};
  header.ground_speed = pose->ground_speed;
  if (const antenna::ScanPattern& pattern = antenna.pattern(); pattern.bars > 1) {
    const geo::Angle commanded = geo::Angle::degrees(input.command.antenna_elevation_deg);
    header.bars_above = commanded + geo::Angle::degrees(pattern.bar_deg(0)) - step.elevation;
    header.bars_below = step.elevation - commanded - geo::Angle::degrees(pattern.bar_deg(pattern.bars - 1));
  }
  SweepChain::Labels labels;
  labels.tick = input.tick;
  labels.sim_time_ns = input.sim_time_ns;
  labels.epoch = input.epoch;
  labels.scan = scan;
  labels.number = next_sweep++;
  labels.mode = input.command.mode;
  labels.gain = std::min<std::uint8_t>(input.command.gain, physics::kFullGain);
  // An ownship that is flagged valid but has values out of range gives a blank sweep at the last valid position.
  const bool lost = !pose_fresh && (input.flags & databuffer::kTickOwnshipValid) != 0U;
  if (!step.reachable || lost) labels.flags |= databuffer::kSweepBlank;
  if (is_dbs()) {
    const geo::Bearing middle = step.left + 0.5 * (step.right - step.left);
    labels.no_return =
        radar::in_blind_zone(middle - pose->platform.ground_track, configuration.high_resolution.blind_zone_deg);
    const DbsCell cell = dbs_cell(step.left, step.right, *pose, configuration);
    header.beam_azimuth = cell.middle;
    header.dbs_cell_width = cell.width;
    labels.gain = physics::kFullGain;
  }
  if (noise_only) labels.flags |= databuffer::kSweepNoiseOnly;
  if (step.scan_start) labels.flags |= databuffer::kSweepScanStart;
  if (step.scan_end) labels.flags |= databuffer::kSweepScanEnd;
  // A sweep is flagged not ready while a cell within the range does not have the scan's detail, or scenes are still
  // being read.
  const geo::Length range = geo::Length::nautical_miles(input.command.range_nm);
  const radar::Fidelity& fidelity = is_dbs() ? dbs_settings.fidelity : configuration.fidelity;
  const bool complete = environment.terrain.has_detail(scan_detail(fidelity, range)) && environment.scenes_ready;
  if (needs_ground(labels.mode, noise_only, configuration) && !complete) labels.flags |= databuffer::kSweepNotReady;
  return chain().advance(header, labels, environment, sweep);
}

void ScanState::write_status(ModelStatus& status) const {
  const antenna::Antenna::State antenna_state = antenna.state();
  status.antenna_azimuth_deg = antenna_state.azimuth_deg;
  status.antenna_elevation_deg = antenna_state.elevation_deg;
  status.scan_centre_deg = antenna_state.centre_deg;
  status.scan_width_deg = scan_width_deg;
  status.scan_range_m = scan_range_m;
  status.scan_tick = static_cast<std::uint32_t>(antenna_state.tick);
  status.antenna_phase = static_cast<std::uint8_t>(antenna_state.phase);
  status.scan_noise_only = noise_only ? 1 : 0;
  status.scan_direction = static_cast<std::int8_t>(antenna_state.direction);
  status.scan_offset_deg = antenna_state.offset_deg;
  status.scan_rate_dps = antenna_state.rate_dps;
  status.scan_bar = static_cast<std::uint8_t>(antenna_state.tick / antenna.pattern().pass_ticks());
  status.epoch = epoch;
  status.scan = scan;
  status.sweep = next_sweep;
  status.scan_restart = scan_restart;
  status.flags = (frozen ? databuffer::kModelFrozen : 0U) | (scanning ? databuffer::kModelScanning : 0U) |
                 (pose_fresh ? 0U : databuffer::kModelStale);
}

}  // namespace yars::model::kernel
