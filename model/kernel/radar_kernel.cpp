#include "model/kernel/radar_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include "lib/radar/fidelity_preset.hpp"
#include "lib/radar/map_formation.hpp"
#include "lib/radar/modes.hpp"
#include "model/antenna/antenna.hpp"
#include "model/kernel/mappable.hpp"
#include "model/kernel/pose.hpp"
#include "model/kernel/scan_detail.hpp"
#include "model/kernel/sharpened_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/rbm/receiver.hpp"

namespace yars::model::kernel {

using databuffer::ModelStatus;
using databuffer::ModelTick;

namespace {
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
// Terrain a little beyond the range is wanted too: the aircraft moves on while it loads [m].
constexpr double kRegionMarginM = 2000.0;

// SNIFF transmits nothing: ground matters to it only where it hides a jammer.
bool needs_ground(bool silent, const radar::RadarConfiguration& configuration) {
  return !silent || !configuration.world.jamming.jammers.empty();
}

bool sniffs(const databuffer::RadarCommand& command) {
  return (command.flags & databuffer::kSniff) != 0U;
}

bool frozen_by(const databuffer::RadarCommand& command) {
  return (command.flags & databuffer::kFreeze) != 0U;
}
}  // namespace

struct RadarKernel::State {
  explicit State(const radar::RadarConfiguration& given)
      : configuration(given),
        sharpened(sharpened_configuration(given)),
        antenna(given.antenna),
        beam_chain(given),
        sharpened_chain(sharpened),
        maps(configuration) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() = default;

  bool is_sharpened() const { return command.mode == static_cast<std::uint8_t>(radar::Mode::hrm); }
  SweepChain& chain() { return is_sharpened() ? sharpened_chain : beam_chain; }
  void clear_chains();

  bool follow_command(const ModelTick& tick, databuffer::Sweep& sweep);
  void use_samples(std::uint32_t samples);
  void use_fidelity(const ModelTick& tick);
  double wanted_width_deg(const databuffer::RadarCommand& command) const;
  void restart(const databuffer::RadarCommand& command);
  void step_maps(const ModelTick& tick, const terrain::TerrainView& terrain);
  geo::Angle wanted_elevation(const terrain::TerrainView& terrain) const;
  bool gather(const ModelTick& tick, const antenna::AntennaStep& step, const terrain::TerrainView& terrain,
              databuffer::Sweep& sweep);
  void start_scan(const databuffer::RadarCommand& command);
  bool sweep_tick(const ModelTick& tick, const antenna::AntennaStep& step, const terrain::TerrainView& terrain,
                  databuffer::Sweep& sweep);
  void remember(ModelStatus& status) const;

  radar::RadarConfiguration configuration;
  radar::RadarConfiguration sharpened;  // for the HRM PPI
  antenna::Antenna antenna;
  SweepChain beam_chain;
  SweepChain sharpened_chain;
  MapSchedule maps;
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

RadarKernel::RadarKernel(const radar::RadarConfiguration& configuration)
    : state_(std::make_unique<State>(configuration)) {}
RadarKernel::~RadarKernel() = default;
RadarKernel::RadarKernel(RadarKernel&&) noexcept = default;
RadarKernel& RadarKernel::operator=(RadarKernel&&) noexcept = default;

void RadarKernel::resume(const ModelStatus& status) {
  State& state = *state_;
  const auto phase = static_cast<antenna::Phase>(
      std::min<std::uint8_t>(status.antenna_phase, static_cast<std::uint8_t>(antenna::Phase::turning)));
  state.antenna.resume({status.antenna_azimuth_deg, status.antenna_elevation_deg, status.scan_centre_deg,
                        status.scan_width_deg, static_cast<int>(std::min<std::uint32_t>(status.scan_tick, 1U << 20U)),
                        status.scan_direction, phase, status.scan_offset_deg, status.scan_rate_dps});
  state.clear_chains();
  state.maps.resume(status);
  state.scan_width_deg = status.scan_width_deg;
  state.scan_range_m = status.scan_range_m;
  state.epoch = status.epoch;
  state.scan = status.scan;
  state.next_sweep = status.sweep;
  state.scan_restart = status.scan_restart;
  state.scanning = (status.flags & databuffer::kModelScanning) != 0U && phase != antenna::Phase::parked;
  state.frozen = (status.flags & databuffer::kModelFrozen) != 0U;
  state.noise_only = status.scan_noise_only != 0;
  state.started = true;
}

RadarKernel::Need RadarKernel::need(const ModelTick& tick) const {
  Need need;
  const bool stays_frozen = state_->frozen && frozen_by(tick.command);
  const bool scans = asks_for_video(tick.command) && !state_->maps.keeps_from_scanning(tick.command);
  if (!scans || stays_frozen) return need;
  // A scan that began before SNIFF transmits to its end.
  const bool silent = sniffs(tick.command) && (state_->noise_only || !state_->scanning);
  if (!needs_ground(silent, state_->configuration)) return need;
  const std::optional<Pose> pose = pose_of(tick.ownship);
  if (!pose && !state_->pose) return need;
  need.ground = true;
  need.region.centre = pose ? pose->place : state_->pose->place;
  const geo::Length range = geo::Length::nautical_miles(tick.command.range_nm);
  need.region.radius_m = range.metres() + kRegionMarginM;
  const bool sharp = tick.command.mode == static_cast<std::uint8_t>(radar::Mode::hrm);
  need.region.detail = scan_detail(sharp ? state_->sharpened.fidelity : state_->configuration.fidelity, range);
  return need;
}

bool RadarKernel::step(const ModelTick& tick, const terrain::TerrainView& terrain, databuffer::Sweep& sweep) {
  State& state = *state_;
  state.tick = tick.tick;
  state.sim_time_ns = tick.sim_time_ns;
  state.pose_fresh = false;
  if ((tick.flags & databuffer::kTickOwnshipValid) != 0U) {
    if (const auto pose = pose_of(tick.ownship)) {
      state.pose = pose;
      state.pose_fresh = true;
    }
  }
  if (!state.configuration.fidelity.automatic) state.use_samples(tick.samples);
  if (!state.pose) {
    state.command = tick.command;
    return false;
  }
  state.step_maps(tick, terrain);
  const bool finished = state.follow_command(tick, sweep);
  if (!state.scanning) return finished;
  if (state.is_sharpened() && state.antenna.between_scans())
    state.antenna.aim(sharpened_sector(state.command, *state.pose, state.configuration).offset_deg);
  const antenna::AntennaStep beam = state.antenna.step(state.pose->platform, state.wanted_elevation(terrain));
  if (beam.phase != antenna::Phase::sweeping) return state.chain().flush(sweep);
  return state.is_sharpened() ? state.gather(tick, beam, terrain, sweep) : state.sweep_tick(tick, beam, terrain, sweep);
}

const MapSchedule& RadarKernel::maps() const {
  return state_->maps;
}
bool RadarKernel::map_due() const {
  return state_->maps.due(state_->tick);
}
void RadarKernel::complete_map() {
  state_->maps.complete();
}

void RadarKernel::State::clear_chains() {
  beam_chain.clear();
  sharpened_chain.clear();
  gathered_ticks = 0;
}

void RadarKernel::State::step_maps(const ModelTick& given, const terrain::TerrainView& terrain) {
  const geo::GeoPoint place{given.command.map_latitude_deg, given.command.map_longitude_deg};
  const bool known = std::isfinite(place.latitude_deg) && std::isfinite(place.longitude_deg);
  maps.step(given, *pose, known ? terrain.elevation_m(place) : kUnknown);
}

// In HRM the dish follows the cursor.
geo::Angle RadarKernel::State::wanted_elevation(const terrain::TerrainView& terrain) const {
  const geo::GeoPoint cursor{command.cursor_latitude_deg, command.cursor_longitude_deg};
  const bool known = (command.flags & databuffer::kCursorValid) != 0U && std::isfinite(cursor.latitude_deg) &&
                     std::isfinite(cursor.longitude_deg);
  if (!is_sharpened() || !known) return geo::Angle::degrees(command.antenna_elevation_deg);
  return elevation_to(*pose, cursor, terrain.elevation_m(cursor));
}

// A sharpened sweep takes several ticks: its edges are those of the first and of the last.
bool RadarKernel::State::gather(const ModelTick& given, const antenna::AntennaStep& step,
                                const terrain::TerrainView& terrain, databuffer::Sweep& sweep) {
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
  if (gathered_ticks < ticks_a_sharpened_sweep(configuration) && !step.scan_end) return false;
  gathered_ticks = 0;
  return sweep_tick(given, gathered, terrain, sweep);
}

// Power, mode, freeze, restart: decides whether this tick scans. True if it ended a scan whose last sweep came out.
bool RadarKernel::State::follow_command(const ModelTick& given, databuffer::Sweep& sweep) {
  command = given.command;
  const bool jumped = started && given.epoch != epoch;
  epoch = given.epoch;
  started = true;
  if (!asks_for_video(command)) {
    if (scanning) antenna.park();
    scanning = false;
    frozen = false;
    clear_chains();
    return false;
  }
  if (maps.keeps_from_scanning(command)) {
    if (scanning) antenna.park();
    scanning = false;
    clear_chains();
    return false;
  }
  if (frozen_by(command)) {
    if (frozen || !scanning || antenna.between_scans()) {
      if (scanning) antenna.park();
      scanning = false;
      frozen = true;
      return chain().flush(sweep);
    }
  } else if (frozen || !scanning) {
    frozen = false;
    restart(command);
    return false;
  }
  if (jumped || command.scan_restart != scan_restart || wanted_width_deg(command) != scan_width_deg) restart(command);
  return false;
}

void RadarKernel::State::use_samples(std::uint32_t samples) {
  if (samples == 0 || samples == beam_chain.samples() || samples > static_cast<std::uint32_t>(radar::kMaxSamples))
    return;
  configuration.fidelity.samples = static_cast<int>(samples);
  beam_chain = SweepChain(configuration);
}

// The tick names the preset that was picked; it comes into force with a scan, so that no scan is half one, half
// another.
void RadarKernel::State::use_fidelity(const ModelTick& given) {
  const std::string_view name(given.fidelity, strnlen(given.fidelity, sizeof given.fidelity));
  if (name == configuration.fidelity.name) return;
  const auto preset = radar::fidelity_preset(name);
  if (!preset) return;
  const radar::Fidelity before = configuration.fidelity;
  configuration.fidelity = *preset;
  configuration.fidelity.automatic = true;
  configuration.fidelity.core_share = before.core_share;
  beam_chain = SweepChain(configuration);
  sharpened = sharpened_configuration(configuration);
  sharpened_chain = SweepChain(sharpened);
}

// A width that is not a number would differ from itself and restart the scan at each tick: the one in force stands.
double RadarKernel::State::wanted_width_deg(const databuffer::RadarCommand& given) const {
  return std::isfinite(given.scan_width_deg) ? given.scan_width_deg : scan_width_deg;
}

void RadarKernel::State::restart(const databuffer::RadarCommand& given) {
  scan_restart = given.scan_restart;
  scan_width_deg = wanted_width_deg(given);
  scanning = true;
  if (is_sharpened()) {
    antenna.restart(sharpened_sector(given, *pose, configuration));
  } else {
    antenna.restart(scan_width_deg);
  }
  clear_chains();
}

// What holds for a whole scan.
void RadarKernel::State::start_scan(const databuffer::RadarCommand& given) {
  ++scan;
  scan_range_m = geo::Length::nautical_miles(given.range_nm).metres();
  noise_only = sniffs(given);
}

bool RadarKernel::State::sweep_tick(const ModelTick& given, const antenna::AntennaStep& step,
                                    const terrain::TerrainView& terrain, databuffer::Sweep& sweep) {
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
  SweepChain::Labels labels;
  labels.tick = given.tick;
  labels.sim_time_ns = given.sim_time_ns;
  labels.epoch = given.epoch;
  labels.scan = scan;
  labels.number = next_sweep++;
  labels.mode = given.command.mode;
  labels.gain = std::min<std::uint8_t>(given.command.gain, rbm::kFullGain);
  // A pose that is not a pose: the place is the last good one, and nothing is received.
  const bool lost = !pose_fresh && (given.flags & databuffer::kTickOwnshipValid) != 0U;
  if (!step.reachable || lost) labels.flags |= databuffer::kSweepBlank;
  if (is_sharpened()) {
    const geo::Bearing middle = step.left + 0.5 * (step.right - step.left);
    if (radar::in_blind_zone(middle - pose->platform.ground_track, configuration.high_resolution))
      labels.flags |= databuffer::kSweepBlank;
    place.looked_at = sharpened_azimuth(middle, *pose, configuration);
    labels.gain = rbm::kFullGain;
  }
  if (noise_only) labels.flags |= databuffer::kSweepNoiseOnly;
  if (step.scan_start) labels.flags |= databuffer::kSweepScanStart;
  if (step.scan_end) labels.flags |= databuffer::kSweepScanEnd;
  // Another detail than the scan's still stands in: the sweep is not what it will be.
  const geo::Length wanted = geo::Length::nautical_miles(given.command.range_nm);
  const radar::Fidelity& fidelity = is_sharpened() ? sharpened.fidelity : configuration.fidelity;
  if (needs_ground(noise_only, configuration) && !terrain.serves(scan_detail(fidelity, wanted)))
    labels.flags |= databuffer::kSweepNotReady;
  return chain().advance(place, labels, terrain, sweep);
}

void RadarKernel::State::remember(ModelStatus& status) const {
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

void RadarKernel::describe(const terrain::TerrainView& terrain, ModelStatus& status) const {
  const State& state = *state_;
  state.remember(status);
  status.tick = state.tick;
  status.sim_time_ns = state.sim_time_ns;
  status.terrain_generation = terrain.generation();
  status.posts_pending = state.beam_chain.posts_pending() + state.sharpened_chain.posts_pending();
  status.mode = state.command.mode;
  std::fill(std::begin(status.fidelity), std::end(status.fidelity), '\0');
  state.configuration.fidelity.name.copy(status.fidelity, sizeof status.fidelity - 1);

  const geo::GeoPoint cursor{state.command.cursor_latitude_deg, state.command.cursor_longitude_deg};
  const bool cursor_known = std::isfinite(cursor.latitude_deg) && std::isfinite(cursor.longitude_deg);
  status.cursor_ground_elevation_m = cursor_known ? terrain.elevation_m(cursor) : kUnknown;
  status.ground_elevation_m = state.pose ? terrain.elevation_m(state.pose->place) : kUnknown;
  status.height_above_ground_m = state.pose ? state.pose->altitude.metres() - status.ground_elevation_m : kUnknown;

  std::fill(std::begin(status.why_not), std::end(status.why_not), '\0');
  const auto reason =
      !state.pose ? std::optional<std::string_view>("NO POSITION")
                  : why_not_mappable(state.pose->platform, state.pose->place, cursor,
                                     geo::Length::nautical_miles(state.command.window_nm), state.configuration.antenna);
  status.mappable = reason ? 0 : 1;
  // While nothing forms the timer says what a map at the cursor would take.
  status.map_timer_s = kUnknown;
  if (!reason)
    status.map_timer_s = state.maps.estimate_s(state.command, *state.pose, cursor, status.cursor_ground_elevation_m,
                                               state.command.window_nm);
  state.maps.describe(state.tick, status);
  if (reason) reason->copy(status.why_not, sizeof status.why_not - 1);
}

}  // namespace yars::model::kernel
