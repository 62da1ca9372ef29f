#include "databuffer/records/model_validation.hpp"

#include "databuffer/records/inspection.hpp"
#include "databuffer/records/validation.hpp"

namespace yars::databuffer {

namespace {

constexpr double kHighest = 200'000.0;                // [m] of an aircraft
constexpr double kFarthest = 1852.0 * kLargestRange;  // [m]
constexpr double kLatest_ns = 0x1p62;                 // [ns] 146 years of sim time: sums of two still fit
constexpr double kLatestTick = kLatest_ns / radar::kTickNanoseconds;
constexpr double kLongestTimer = 1e6;      // [s]
constexpr double kFastestScan = 10'000.0;  // [deg/s]
constexpr int kPhases = 4;                 // antenna::Phase, the last
constexpr int kModes = 7;                  // radar::Mode, the last
constexpr int kFullGain = 3;

void inspect_surroundings(Inspection& inspection, const ModelStatus& status) {
  const auto unknown = Missing::allowed;
  inspection.range("antenna_azimuth_deg", status.antenna_azimuth_deg, -180.0, 180.0, unknown);
  inspection.range("antenna_elevation_deg", status.antenna_elevation_deg, -90.0, 90.0, unknown);
  inspection.range("height_above_ground_m", status.height_above_ground_m, -kHighest, kHighest - kLowestGround, unknown);
  inspection.range("ground_elevation_m", status.ground_elevation_m, kLowestGround, kHighestGround, unknown);
  inspection.range("cursor_ground_elevation_m", status.cursor_ground_elevation_m, kLowestGround, kHighestGround,
                   unknown);
}

void inspect_scan(Inspection& inspection, const ModelStatus& status) {
  inspection.range("scan_centre_deg", status.scan_centre_deg, -360.0, 360.0);
  inspection.range("scan_width_deg", status.scan_width_deg, 0.0, 360.0);
  inspection.range("scan_range_m", status.scan_range_m, 0.0, kFarthest);
  inspection.range("scan_offset_deg", status.scan_offset_deg, -360.0, 360.0);
  inspection.range("scan_rate_dps", status.scan_rate_dps, 0.0, kFastestScan);
  inspection.range("scan_direction", status.scan_direction, -1, 1);
  inspection.range("antenna_phase", status.antenna_phase, 0, kPhases);
  inspection.range("mode", status.mode, 0, kModes);
}

void inspect_map_under_way(Inspection& inspection, const ModelStatus& status) {
  inspection.range("map_timer_s", status.map_timer_s, 0.0, kLongestTimer, Missing::allowed);
  inspection.range("map_progress", status.map_progress, 0.0, 1.0, Missing::allowed);
  inspection.latitude("map_latitude_deg", status.map_latitude_deg);
  inspection.longitude("map_longitude_deg", status.map_longitude_deg);
  inspection.range("map_up_deg", status.map_up_deg, 0.0, 360.0);
  inspection.range("map_window_nm", status.map_window_nm, 0.0, kLargestRange);
  inspection.range("mappable", status.mappable, 0, 1);
  inspection.picture_id("map_newest", status.map_newest);
}

void inspect_measured(Inspection& inspection, const ModelStatus& status) {
  inspection.speed("velocity_north_mps", status.velocity_north_mps);
  inspection.speed("velocity_east_mps", status.velocity_east_mps);
  inspection.speed("velocity_down_mps", status.velocity_down_mps);
  inspection.range("velocity_due_tick", static_cast<double>(status.velocity_due_tick), -1.0, kLatestTick);
}

}  // namespace

Refusal why_refused(const ModelStatus& status) {
  Inspection inspection;
  inspection.range("tick", static_cast<double>(status.tick), 0.0, kLatestTick);
  inspection.range("sim_time_ns", static_cast<double>(status.sim_time_ns), 0.0, kLatest_ns);
  inspection.range("ownship_received_ns", static_cast<double>(status.ownship_received_ns), 0.0, kLatest_ns);
  inspection.range("load", status.load, 0.0, kLongestTimer);
  inspect_surroundings(inspection, status);
  inspect_scan(inspection, status);
  inspect_map_under_way(inspection, status);
  inspect_measured(inspection, status);
  inspection.latitude("answered_latitude_deg", status.answered_latitude_deg);
  inspection.longitude("answered_longitude_deg", status.answered_longitude_deg);
  inspection.range("answered_elevation_m", status.answered_elevation_m, kLowestGround, kHighestGround,
                   Missing::allowed);
  inspection.text("why_not", status.why_not);
  inspection.text("map_stopped", status.map_stopped);
  inspection.text("fidelity", status.fidelity);
  if (const auto refusal = why_refused(status.ownship)) return "ownship: " + *refusal;
  if (const auto refusal = why_refused(status.nav)) return "nav: " + *refusal;
  return inspection.result();
}

Refusal why_refused(const Sweep& sweep) {
  Inspection inspection;
  inspection.range("tick", static_cast<double>(sweep.tick), 0.0, kLatestTick);
  inspection.range("sim_time_ns", static_cast<double>(sweep.sim_time_ns), 0.0, kLatest_ns);
  inspection.latitude("apex_latitude_deg", sweep.apex_latitude_deg);
  inspection.longitude("apex_longitude_deg", sweep.apex_longitude_deg);
  inspection.range("apex_altitude_msl_m", sweep.apex_altitude_msl_m, -1'000.0, kHighest);
  inspection.range("azimuth_left_deg", sweep.azimuth_left_deg, 0.0, 360.0);
  inspection.range("azimuth_right_deg", sweep.azimuth_right_deg, 0.0, 360.0);
  inspection.range("ground_track_deg", sweep.ground_track_deg, 0.0, 360.0);
  inspection.range("elevation_deg", sweep.elevation_deg, -90.0, 90.0);
  inspection.range("range_m", sweep.range_m, 0.0, kFarthest);
  inspection.range("samples", sweep.samples, 0, radar::kMaxSamples);
  inspection.range("mode", sweep.mode, 0, kModes);
  inspection.range("gain", sweep.gain, 0, kFullGain);
  inspection.range("direction", sweep.direction, 0, 1);
  return inspection.result();
}

Refusal why_refused(const ModelTick& tick) {
  Inspection inspection;
  inspection.range("tick", static_cast<double>(tick.tick), 0.0, kLatestTick);
  inspection.range("sim_time_ns", static_cast<double>(tick.sim_time_ns), 0.0, kLatest_ns);
  inspection.range("resumed_tick", static_cast<double>(tick.resumed_tick), -1.0, kLatestTick);
  inspection.range("samples", tick.samples, 0, radar::kMaxSamples);
  inspection.range("command.range_nm", tick.command.range_nm, 0.0, kLargestRange);
  inspection.range("command.scan_width_deg", tick.command.scan_width_deg, 0.0, 360.0);
  inspection.range("command.antenna_elevation_deg", tick.command.antenna_elevation_deg, -90.0, 90.0);
  inspection.range("command.mode", tick.command.mode, 0, kModes);
  inspection.text("fidelity", tick.fidelity);
  if (const auto refusal = why_refused(tick.ownship)) return "ownship: " + *refusal;
  return inspection.result();
}

}  // namespace yars::databuffer
