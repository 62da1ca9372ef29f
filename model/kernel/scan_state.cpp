#include "model/kernel/scan_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "lib/radar/configuration.hpp"
#include "lib/radar/mapping.hpp"
#include "lib/text/plain_text.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/physics/receiver.hpp"

namespace yars::model::kernel {

namespace {
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
}  // namespace

void ScanState::clear_chains() {
  beam_chain.clear();
  dbs_chain.clear();
  gathered_ticks = 0;
}

void ScanState::step_maps(const ModelTick& given, const terrain::TerrainView& terrain) {
  if ((given.flags & databuffer::kTickMapComplete) != 0U && maps.forming()) maps.complete();
  const geo::GeoPoint place{given.command.map_latitude_deg, given.command.map_longitude_deg};
  const bool known = std::isfinite(place.latitude_deg) && std::isfinite(place.longitude_deg);
  maps.step(given, *pose, known ? terrain.elevation_m(place) : kUnknown, !velocity.wanted());
}

void ScanState::stop_scanning() {
  if (scanning) antenna.park();
  scanning = false;
}

// What the dish does while it is not needed for a scan: a map comes first, then a round of beams.
void ScanState::point_unless_scanning(const ModelTick& given, const terrain::TerrainView& terrain) {
  if (scanning) return;
  const antenna::Platform& platform = pose->platform;
  const bool measures = velocity.wanted() && !maps.forming();
  if (!measures) velocity.give_up();
  if (measures) {
    const DopplerVelocityUpdate::Direction beam = velocity.direction(platform);
    const bool arrived = antenna.point(platform, beam.azimuth, beam.elevation);
    const bool within = antenna::within_gimbal(platform, configuration.antenna, beam.azimuth, beam.elevation);
    velocity.step(given, *pose, arrived, within);
  } else if (const auto target = maps.looked_at(given, *pose)) {
    const geo::Bearing azimuth = geo::geodesic_inverse(pose->place, *target).azimuth_at_start;
    antenna.point(platform, azimuth, elevation_to(*pose, *target, terrain.elevation_m(*target)));
  } else {
    antenna.park();
  }
}

// In HRM the dish follows the cursor.
geo::Angle ScanState::wanted_elevation(const terrain::TerrainView& terrain) const {
  const geo::GeoPoint cursor{command.cursor_latitude_deg, command.cursor_longitude_deg};
  const bool known = (command.flags & databuffer::kCursorValid) != 0U && std::isfinite(cursor.latitude_deg) &&
                     std::isfinite(cursor.longitude_deg);
  if (!is_dbs() || !known) return geo::Angle::degrees(command.antenna_elevation_deg);
  return elevation_to(*pose, cursor, terrain.elevation_m(cursor));
}

// A sharpened sweep takes several ticks: its edges are those of the first and of the last.
bool ScanState::gather(const ModelTick& given, const antenna::AntennaStep& step, const physics::Environment& database,
                       databuffer::Sweep& sweep) {
  if (gathered_ticks == 0) {
    gathered = step;
  } else {
    if (step.direction > 0) gathered.right = step.right;
    if (step.direction < 0) gathered.left = step.left;
    gathered.reachable = gathered.reachable && step.reachable;
    gathered.scan_end = step.scan_end;
    gathered.elevation = step.elevation;
  }
  ++gathered_ticks;
  if (gathered_ticks < ticks_a_dbs_sweep(configuration) && !step.scan_end) return false;
  gathered_ticks = 0;
  return sweep_tick(given, gathered, database, sweep);
}

// Power, mode, freeze, restart: decides whether this tick scans. True if it ended a scan whose last sweep came out.
bool ScanState::follow_command(const ModelTick& given, databuffer::Sweep& sweep) {
  command = given.command;
  const bool jumped = started && given.epoch != epoch;
  epoch = given.epoch;
  started = true;
  if (jumped) velocity.give_up();
  if (!asks_for_video(command)) {
    stop_scanning();
    frozen = false;
    clear_chains();
    return false;
  }
  if (maps.keeps_from_scanning(command)) {
    stop_scanning();
    clear_chains();
    return false;
  }
  if (frozen_by(command)) {
    // HRM falls silent at once; else a scan is ended.
    const bool silenced = is_dbs() && sniffs(command);
    if (frozen || !scanning || silenced || antenna.between_scans()) {
      stop_scanning();
      frozen = true;
      return chain().flush(sweep);
    }
  } else if (velocity.wanted() && (!scanning || antenna.between_scans())) {
    stop_scanning();
    frozen = false;
    return chain().flush(sweep);
  } else if (frozen || !scanning) {
    frozen = false;
    restart(command);
    return false;
  }
  if (jumped || command.scan_restart != scan_restart || wanted_width_deg(command) != scan_width_deg) restart(command);
  return false;
}

void ScanState::use_samples(std::uint32_t samples) {
  if (samples == 0 || samples == beam_chain.samples() || samples > static_cast<std::uint32_t>(radar::kMaxSamples))
    return;
  configuration.fidelity.samples = static_cast<int>(samples);
  beam_chain = SweepChain(configuration);
}

// The tick names the preset that was picked; it comes into force with a scan, so that no scan is half one, half
// another.
void ScanState::use_fidelity(const ModelTick& given) {
  const std::string_view name = text::text_of(given.fidelity);
  if (name == configuration.fidelity.name) return;
  const auto preset = radar::fidelity_preset(name);
  if (!preset) return;
  const radar::Fidelity before = configuration.fidelity;
  configuration.fidelity = *preset;
  configuration.fidelity.automatic = true;
  configuration.fidelity.core_share = before.core_share;
  beam_chain = SweepChain(configuration);
  sharpened = dbs_configuration(configuration);
  dbs_chain = SweepChain(sharpened);
}

// A width that is not a number would differ from itself and restart the scan at each tick: the one in force stands.
double ScanState::wanted_width_deg(const databuffer::RadarCommand& given) const {
  return std::isfinite(given.scan_width_deg) ? given.scan_width_deg : scan_width_deg;
}

void ScanState::restart(const databuffer::RadarCommand& given) {
  scan_restart = given.scan_restart;
  scan_width_deg = wanted_width_deg(given);
  scanning = true;
  if (is_dbs()) {
    antenna.restart(dbs_sector(given, *pose, configuration));
  } else {
    antenna.restart(scan_width_deg);
  }
  clear_chains();
}

// What holds for a whole scan.
void ScanState::start_scan(const databuffer::RadarCommand& given) {
  ++scan;
  scan_range_m = geo::Length::nautical_miles(given.range_nm).metres();
  noise_only = sniffs(given);
}

bool ScanState::sweep_tick(const ModelTick& given, const antenna::AntennaStep& step,
                           const physics::Environment& database, databuffer::Sweep& sweep) {
  if (step.scan_start || scan_range_m <= 0.0) {
    if (configuration.fidelity.automatic) use_fidelity(given);
    start_scan(given.command);
  }
  SweepPlace place{pose->place,
                   pose->altitude,
                   step.left,
                   step.right,
                   pose->platform.ground_track,
                   step.elevation,
                   geo::Length::metres(scan_range_m),
                   step.direction,
                   sim_time_of(given.sim_time_ns),
                   given.command.band,
                   given.command.channel};
  if (const antenna::ScanPattern& pattern = antenna.pattern(); pattern.bars > 1) {
    const geo::Angle commanded = geo::Angle::degrees(given.command.antenna_elevation_deg);
    place.bars_above = commanded + geo::Angle::degrees(pattern.bar_deg(0)) - step.elevation;
    place.bars_below = step.elevation - commanded - geo::Angle::degrees(pattern.bar_deg(pattern.bars - 1));
  }
  SweepChain::Labels labels;
  labels.tick = given.tick;
  labels.sim_time_ns = given.sim_time_ns;
  labels.epoch = given.epoch;
  labels.scan = scan;
  labels.number = next_sweep++;
  labels.mode = given.command.mode;
  labels.gain = std::min<std::uint8_t>(given.command.gain, physics::kFullGain);
  // A pose that is not a pose: the place is the last good one, and nothing is received.
  const bool lost = !pose_fresh && (given.flags & databuffer::kTickOwnshipValid) != 0U;
  if (!step.reachable || lost) labels.flags |= databuffer::kSweepBlank;
  if (is_dbs()) {
    const geo::Bearing middle = step.left + 0.5 * (step.right - step.left);
    labels.dark = radar::in_blind_zone(middle - pose->platform.ground_track, configuration.high_resolution);
    const DbsCell cell = dbs_cell(step.left, step.right, *pose, configuration);
    place.looked_at = cell.middle;
    place.resolved = cell.width;
    labels.gain = physics::kFullGain;
  }
  if (noise_only) labels.flags |= databuffer::kSweepNoiseOnly;
  if (step.scan_start) labels.flags |= databuffer::kSweepScanStart;
  if (step.scan_end) labels.flags |= databuffer::kSweepScanEnd;
  // Another detail than the scan's still stands in, or scenes are being read: the sweep is not what it will be.
  const geo::Length wanted = geo::Length::nautical_miles(given.command.range_nm);
  const radar::Fidelity& fidelity = is_dbs() ? sharpened.fidelity : configuration.fidelity;
  const bool whole = database.terrain.serves(scan_detail(fidelity, wanted)) && database.scenes_ready;
  if (needs_ground(labels.mode, noise_only, configuration) && !whole) labels.flags |= databuffer::kSweepNotReady;
  return chain().advance(place, labels, database, sweep);
}

void ScanState::remember(ModelStatus& status) const {
  const antenna::Antenna::Memory memory = antenna.memory();
  status.antenna_azimuth_deg = memory.azimuth_deg;
  status.antenna_elevation_deg = memory.elevation_deg;
  status.scan_centre_deg = memory.centre_deg;
  status.scan_width_deg = scan_width_deg;
  status.scan_range_m = scan_range_m;
  status.scan_tick = static_cast<std::uint32_t>(memory.tick);
  status.antenna_phase = static_cast<std::uint8_t>(memory.phase);
  status.scan_noise_only = noise_only ? 1 : 0;
  status.scan_direction = static_cast<std::int8_t>(memory.direction);
  status.scan_offset_deg = memory.offset_deg;
  status.scan_rate_dps = memory.rate_dps;
  status.scan_bar = static_cast<std::uint8_t>(memory.tick / antenna.pattern().pass_ticks());
  status.epoch = epoch;
  status.scan = scan;
  status.sweep = next_sweep;
  status.scan_restart = scan_restart;
  status.flags = (frozen ? databuffer::kModelFrozen : 0U) | (scanning ? databuffer::kModelScanning : 0U) |
                 (pose_fresh ? 0U : databuffer::kModelStale);
}

}  // namespace yars::model::kernel
