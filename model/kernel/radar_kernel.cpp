#include "model/kernel/radar_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "lib/radar/mission.hpp"
#include "lib/text/plain_text.hpp"
#include "model/kernel/scan_state.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::model::kernel {

namespace {
// [m] Margin of the terrain region beyond the range, for the movement of the aircraft while terrain loads.
constexpr double kRegionMargin_m = 2000.0;

// Pose of a tick; nullopt if its ownship is not flagged valid or has values out of range. Without the flag the ownship
// can be all zero, which would count as a position.
std::optional<Pose> valid_pose_of(const ModelTick& tick) {
  if ((tick.flags & databuffer::kTickOwnshipValid) == 0U) return std::nullopt;
  return pose_of(tick.ownship);
}
}  // namespace

struct RadarKernel::State : ScanState {
  using ScanState::ScanState;
};

RadarKernel::RadarKernel(const radar::RadarConfiguration& configuration)
    : state_(std::make_unique<State>(configuration)) {}
RadarKernel::~RadarKernel() = default;
RadarKernel::RadarKernel(RadarKernel&&) noexcept = default;
RadarKernel& RadarKernel::operator=(RadarKernel&&) noexcept = default;

void RadarKernel::resume(const ModelStatus& status) {
  State& state = *state_;
  const auto phase = static_cast<antenna::Phase>(
      std::min<std::uint8_t>(status.antenna_phase, static_cast<std::uint8_t>(antenna::Phase::pointing)));
  state.antenna.resume({status.antenna_azimuth_deg, status.antenna_elevation_deg, status.scan_centre_deg,
                        status.scan_width_deg, static_cast<int>(std::min<std::uint32_t>(status.scan_tick, 1U << 20U)),
                        status.scan_direction, phase, status.scan_offset_deg, status.scan_rate_dps});
  state.use_fidelity(text::text_of(status.fidelity));
  state.clear_chains();
  state.maps.resume(status);
  state.velocity.resume(status);
  state.scan_width_deg = status.scan_width_deg;
  state.scan_range_m = status.scan_range_m;
  state.epoch = status.epoch;
  state.scan = status.scan;
  state.next_sweep = status.sweep;
  state.scan_restart = status.scan_restart;
  const bool parked_or_pointing = phase == antenna::Phase::parked || phase == antenna::Phase::pointing;
  state.scanning = (status.flags & databuffer::kModelScanning) != 0U && !parked_or_pointing;
  state.frozen = (status.flags & databuffer::kModelFrozen) != 0U;
  state.noise_only = status.scan_noise_only != 0;
  state.started = true;
}

void RadarKernel::use_world(const radar::WorldConfiguration& world) {
  state_->use_world(world);
}

RadarKernel::Need RadarKernel::need(const ModelTick& tick) const {
  Need need;
  const bool stays_frozen = state_->frozen && frozen_by(tick.command);
  const bool scans = requests_scan(tick.command) && !state_->maps.blocks_scanning(tick.command);
  if (!scans || stays_frozen) return need;
  // A scan that began before SNIFF (receive only) transmits until its end.
  const bool silent = sniffs(tick.command) && (state_->noise_only || !state_->scanning);
  if (!needs_ground(tick.command.mode, silent, state_->configuration)) return need;
  const std::optional<Pose> pose = valid_pose_of(tick);
  if (!pose && !state_->pose) return need;
  need.ground = true;
  need.region.centre = pose ? pose->position : state_->pose->position;
  const geo::Length range = geo::Length::nautical_miles(tick.command.range_nm);
  need.region.radius_m = range.metres() + kRegionMargin_m;
  const bool dbs = tick.command.mode == static_cast<std::uint8_t>(radar::Mode::hrm);
  need.region.detail = scan_detail(dbs ? state_->dbs_settings.fidelity : state_->configuration.fidelity, range);
  return need;
}

bool RadarKernel::step(const ModelTick& tick, const physics::Environment& environment, databuffer::Sweep& sweep) {
  const terrain::TerrainView& terrain = environment.terrain;
  State& state = *state_;
  state.tick = tick.tick;
  state.sim_time_ns = tick.sim_time_ns;
  state.pose_fresh = false;
  if (const auto pose = valid_pose_of(tick)) {
    state.pose = pose;
    state.pose_fresh = true;
  }
  // The samples are those of the preset that the tick names, which comes into use when a scan begins.
  const std::string_view preset = text::text_of(tick.fidelity);
  const bool is_in_use = preset.empty() || preset == state.configuration.fidelity.name;
  if (!state.configuration.fidelity.automatic && is_in_use) state.use_samples(tick.samples);
  if (!state.pose) {
    state.command = tick.command;
    return false;
  }
  state.velocity.read_command(tick);
  state.step_maps(tick, terrain);
  const bool finished = state.follow_command(tick, sweep);
  state.point_unless_scanning(tick, terrain);
  if (!state.scanning) return finished;
  if (state.is_dbs() && state.antenna.between_scans())
    state.antenna.aim(dbs_sector(state.command, *state.pose, state.configuration).offset_deg);
  const antenna::AntennaStep beam = state.antenna.step(state.pose->platform, state.commanded_elevation(terrain));
  if (beam.phase != antenna::Phase::sweeping) return state.chain().flush(sweep);
  return state.is_dbs() ? state.accumulate(tick, beam, environment, sweep)
                        : state.sweep_tick(tick, beam, environment, sweep);
}

void answer_elevation(const databuffer::RadarState& request, const terrain::TerrainView& terrain, ModelStatus& status) {
  status.answered_latitude_deg = request.asked_latitude_deg;
  status.answered_longitude_deg = request.asked_longitude_deg;
  status.answered_elevation_m = terrain.elevation_m({request.asked_latitude_deg, request.asked_longitude_deg});
}

const MapSchedule& RadarKernel::maps() const {
  return state_->maps;
}

void RadarKernel::describe(const terrain::TerrainView& terrain, ModelStatus& status) const {
  const State& state = *state_;
  state.write_status(status);
  status.tick = state.tick;
  status.sim_time_ns = state.sim_time_ns;
  status.terrain_generation = terrain.generation();
  status.posts_pending = state.beam_chain.posts_pending() + state.dbs_chain.posts_pending();
  status.mode = state.command.mode;
  std::fill(std::begin(status.fidelity), std::end(status.fidelity), '\0');
  state.configuration.fidelity.name.copy(status.fidelity, sizeof status.fidelity - 1);

  const geo::GeoPoint cursor{state.command.cursor_latitude_deg, state.command.cursor_longitude_deg};
  const bool cursor_known = std::isfinite(cursor.latitude_deg) && std::isfinite(cursor.longitude_deg);
  status.cursor_ground_elevation_m = cursor_known ? terrain.elevation_m(cursor) : kUnknown;
  status.ground_elevation_m = state.pose ? terrain.elevation_m(state.pose->position) : kUnknown;
  status.height_above_ground_m = state.pose ? state.pose->altitude.metres() - status.ground_elevation_m : kUnknown;

  std::fill(std::begin(status.why_not), std::end(status.why_not), '\0');
  const auto reason =
      !state.pose ? std::optional<std::string_view>("NO POSITION")
                  : radar::map_rejection(viewpoint_of(*state.pose), {cursor, status.cursor_ground_elevation_m},
                                         {geo::Length::nautical_miles(state.command.window_nm)}, state.configuration);
  status.mappable = reason ? 0 : 1;
  // Formation time of a map at the cursor. While a map forms, maps.describe() replaces it by the remaining time.
  status.map_timer_s = kUnknown;
  if (!reason)
    status.map_timer_s = state.maps.estimate_s(state.command, *state.pose, cursor, status.cursor_ground_elevation_m,
                                               state.command.window_nm);
  state.maps.describe(state.tick, status);
  state.velocity.describe(status);
  if (reason) reason->copy(status.why_not, sizeof status.why_not - 1);
}

}  // namespace yars::model::kernel
