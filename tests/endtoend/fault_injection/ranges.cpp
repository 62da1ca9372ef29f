#include "tests/endtoend/fault_injection/ranges.hpp"

#include <span>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/radar/modes.hpp"

namespace yars::endtoend::fault_injection {

namespace {

using databuffer::Inspection;
using databuffer::Missing;
using databuffer::Refusal;

constexpr double kFarthest_m = 2.1e7;  // [m] more than half of the Earth's circumference, 2.004e7 m

void inspect_time(Inspection& inspection, std::int64_t tick, std::int64_t sim_time_ns) {
  if (sim_time_ns != tick * radar::kTickNanoseconds)
    inspection.fault("sim_time_ns", "tick " + std::to_string(tick), std::to_string(sim_time_ns));
}

void inspect_part(Inspection& inspection, std::string_view name, const Refusal& refusal) {
  if (refusal) inspection.fault(name, "a record that validate() accepts", *refusal);
}

}  // namespace

Refusal why_out_of_range(const databuffer::ModelTick& tick) {
  Inspection inspection;
  inspect_time(inspection, tick.tick, tick.sim_time_ns);
  inspect_part(inspection, "ownship", databuffer::validate(tick.ownship));
  inspection.range("command.range_nm", tick.command.range_nm, 0.0, databuffer::kMaxRange_nm);
  inspection.range("command.scan_width_deg", tick.command.scan_width_deg, 0.0, 360.0);
  inspection.range("command.antenna_elevation_deg", tick.command.antenna_elevation_deg, -60.0, 60.0);
  inspection.latitude("command.map_latitude_deg", tick.command.map_latitude_deg);
  inspection.longitude("command.map_longitude_deg", tick.command.map_longitude_deg);
  inspection.range("samples", tick.samples, 0, radar::kMaxSamples);
  inspection.text("fidelity", tick.fidelity);
  return inspection.result();
}

Refusal why_out_of_range(const databuffer::ModelStatus& status) {
  if (auto refusal = databuffer::validate(status)) return refusal;
  Inspection inspection;
  inspect_time(inspection, status.tick, status.sim_time_ns);
  return inspection.result();
}

Refusal why_out_of_range(const databuffer::Sweep& sweep) {
  if (auto refusal = databuffer::validate(sweep)) return refusal;
  Inspection inspection;
  inspect_time(inspection, sweep.tick, sweep.sim_time_ns);
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

}  // namespace yars::endtoend::fault_injection
