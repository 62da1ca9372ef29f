#include "tests/endtoend/storm/ranges.hpp"

#include <span>

#include "databuffer/records/inspection.hpp"
#include "databuffer/records/validation.hpp"
#include "lib/radar/limits.hpp"

namespace yars::endtoend::storm {

namespace {

using databuffer::Inspection;
using databuffer::Missing;
using databuffer::Refusal;

constexpr double kFarthest_m = 2.1e7;  // half round the Earth

void inspect_time(Inspection& inspection, std::int64_t tick, std::int64_t sim_time_ns) {
  if (sim_time_ns != tick * radar::kTickNanoseconds)
    inspection.fault("sim_time_ns", "tick " + std::to_string(tick), std::to_string(sim_time_ns));
}

void inspect_part(Inspection& inspection, std::string_view name, const Refusal& refusal) {
  if (refusal) inspection.fault(name, "what the border takes", *refusal);
}

}  // namespace

Refusal why_out_of_range(const databuffer::ModelTick& tick) {
  Inspection inspection;
  inspect_time(inspection, tick.tick, tick.sim_time_ns);
  inspect_part(inspection, "ownship", databuffer::why_refused(tick.ownship));
  inspection.range("command.range_nm", tick.command.range_nm, 0.0, databuffer::kLargestRange);
  inspection.range("command.scan_width_deg", tick.command.scan_width_deg, 0.0, 360.0);
  inspection.range("command.antenna_elevation_deg", tick.command.antenna_elevation_deg, -60.0, 60.0);
  inspection.latitude("command.map_latitude_deg", tick.command.map_latitude_deg);
  inspection.longitude("command.map_longitude_deg", tick.command.map_longitude_deg);
  inspection.range("samples", tick.samples, 0, radar::kMaxSamples);
  inspection.text("fidelity", tick.fidelity);
  return inspection.result();
}

Refusal why_out_of_range(const databuffer::ModelStatus& status) {
  Inspection inspection;
  inspect_time(inspection, status.tick, status.sim_time_ns);
  inspect_part(inspection, "ownship", databuffer::why_refused(status.ownship));
  inspect_part(inspection, "nav", databuffer::why_refused(status.nav));
  inspection.range("antenna_azimuth_deg", status.antenna_azimuth_deg, -180.0, 180.0);
  inspection.range("antenna_elevation_deg", status.antenna_elevation_deg, -90.0, 90.0);
  inspection.range("height_above_ground_m", status.height_above_ground_m, -20'000.0, 220'000.0, Missing::allowed);
  inspection.range("ground_elevation_m", status.ground_elevation_m, databuffer::kLowestGround,
                   databuffer::kHighestGround, Missing::allowed);
  inspection.range("cursor_ground_elevation_m", status.cursor_ground_elevation_m, databuffer::kLowestGround,
                   databuffer::kHighestGround, Missing::allowed);
  inspection.range("map_timer_s", status.map_timer_s, 0.0, 1e5, Missing::allowed);
  inspection.range("map_progress", status.map_progress, 0.0, 1.0, Missing::allowed);
  inspection.range("load", status.load, 0.0, 1e4);
  inspection.range("scan_centre_deg", status.scan_centre_deg, -360.0, 360.0);
  inspection.range("scan_width_deg", status.scan_width_deg, 0.0, 360.0);
  inspection.range("scan_range_m", status.scan_range_m, 0.0, kFarthest_m);
  inspection.speed("velocity_north_mps", status.velocity_north_mps);
  inspection.speed("velocity_east_mps", status.velocity_east_mps);
  inspection.speed("velocity_down_mps", status.velocity_down_mps);
  inspection.text("why_not", status.why_not);
  return inspection.result();
}

Refusal why_out_of_range(const databuffer::Sweep& sweep) {
  Inspection inspection;
  inspect_time(inspection, sweep.tick, sweep.sim_time_ns);
  inspection.latitude("apex_latitude_deg", sweep.apex_latitude_deg);
  inspection.longitude("apex_longitude_deg", sweep.apex_longitude_deg);
  inspection.range("apex_altitude_msl_m", sweep.apex_altitude_msl_m, -1'000.0, 200'000.0);
  inspection.range("azimuth_left_deg", sweep.azimuth_left_deg, -360.0, 360.0);
  inspection.range("azimuth_right_deg", sweep.azimuth_right_deg, -360.0, 360.0);
  inspection.range("ground_track_deg", sweep.ground_track_deg, -360.0, 360.0);
  inspection.range("elevation_deg", sweep.elevation_deg, -90.0, 90.0);
  inspection.range("range_m", sweep.range_m, 0.0, kFarthest_m);
  inspection.range("samples", sweep.samples, 0, radar::kMaxSamples);
  return inspection.result();
}

Refusal why_out_of_range(const databuffer::Outputs& outputs) {
  Inspection inspection;
  inspect_time(inspection, outputs.tick, outputs.sim_time_ns);
  inspection.latitude("cue_latitude_deg", outputs.cue_latitude_deg);
  inspection.longitude("cue_longitude_deg", outputs.cue_longitude_deg);
  inspection.latitude("target_latitude_deg", outputs.target_latitude_deg);
  inspection.longitude("target_longitude_deg", outputs.target_longitude_deg);
  inspection.text("target_name", outputs.target_name);
  inspection.range("slant_range_m", outputs.slant_range_m, 0.0, kFarthest_m, Missing::allowed);
  inspection.range("bearing_deg", outputs.bearing_deg, 0.0, 360.0, Missing::allowed);
  inspection.range("depression_deg", outputs.depression_deg, -90.0, 90.0, Missing::allowed);
  inspection.range("steering_deg", outputs.steering_deg, -360.0, 360.0, Missing::allowed);
  inspection.range("mark_count", outputs.mark_count, 0, databuffer::kMarks);
  for (const auto& mark : std::span(outputs.marks)) {
    inspection.latitude("marks.latitude_deg", mark.latitude_deg);
    inspection.longitude("marks.longitude_deg", mark.longitude_deg);
  }
  return inspection.result();
}

}  // namespace yars::endtoend::storm
