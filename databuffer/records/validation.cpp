#include "databuffer/records/validation.hpp"

#include "databuffer/records/inspection.hpp"

namespace yars::databuffer {

namespace {

// [NM] edge of a map; the glass divides by it.
constexpr double kSmallestWindow = 0.01;
// [m] over ground from the aircraft to a patch map's centre: far beyond any radar's horizon.
constexpr double kFarthestPatch = 1'000'000.0;
// [s] that a map may have taken to form.
constexpr double kLongestFormation = 86'400.0;
// [s] into a recording: three centuries; no recording is longer.
constexpr double kLongestFlight = 1e10;
// [m] and [m²] of what a ship or a vehicle returns: no mast is higher, no ship returns more.
constexpr double kTallestEntity = 1'000.0;
constexpr double kLargestEcho = 1e7;

}  // namespace

Refusal why_refused(const Ownship& ownship) {
  Inspection inspection;
  inspection.latitude("latitude_deg", ownship.latitude_deg);
  inspection.longitude("longitude_deg", ownship.longitude_deg);
  inspection.range("altitude_msl_m", ownship.altitude_msl_m, -1'000.0, 200'000.0);
  inspection.range("heading_deg", ownship.heading_deg, 0.0, 360.0);
  inspection.range("pitch_deg", ownship.pitch_deg, -90.0, 90.0);
  inspection.range("roll_deg", ownship.roll_deg, -180.0, 180.0);
  inspection.speed("velocity_north_mps", ownship.velocity_north_mps);
  inspection.speed("velocity_east_mps", ownship.velocity_east_mps);
  inspection.speed("velocity_down_mps", ownship.velocity_down_mps);
  inspection.range("radar_altitude_m", ownship.radar_altitude_m, 0.0, 200'000.0, Missing::allowed);
  inspection.range("flight_time_s", ownship.flight_time_s, 0.0, kLongestFlight);
  inspection.text("source", ownship.source);
  return inspection.result();
}

Refusal why_refused(const Nav& nav) {
  Inspection inspection;
  inspection.latitude("mission_latitude_deg", nav.mission_latitude_deg);
  inspection.longitude("mission_longitude_deg", nav.mission_longitude_deg);
  inspection.latitude("ins_latitude_deg", nav.ins_latitude_deg);
  inspection.longitude("ins_longitude_deg", nav.ins_longitude_deg);
  inspection.speed("velocity_north_mps", nav.velocity_north_mps);
  inspection.speed("velocity_east_mps", nav.velocity_east_mps);
  inspection.speed("velocity_down_mps", nav.velocity_down_mps);
  inspection.range("magnetic_variation_deg", nav.magnetic_variation_deg, -180.0, 180.0, Missing::allowed);
  return inspection.result();
}

Refusal why_refused(const ClockState& clock) {
  Inspection inspection;
  inspection.range("rate", clock.rate, 0.0, 10.0);
  inspection.range("running", clock.running, 0, 1);
  const auto base = [&inspection](std::string_view field, std::int64_t value_ns) {
    if (value_ns < 0 || value_ns > kLatestClockBase_ns)
      inspection.fault(field, "0 to " + std::to_string(kLatestClockBase_ns) + " ns", std::to_string(value_ns));
  };
  base("base_sim_ns", clock.base_sim_ns);
  base("base_monotonic_ns", clock.base_monotonic_ns);
  // Without a latitude nothing was repositioned, whatever the other fields hold.
  if (std::isnan(clock.reposition_latitude_deg)) return inspection.result();
  inspection.latitude("reposition_latitude_deg", clock.reposition_latitude_deg);
  inspection.longitude("reposition_longitude_deg", clock.reposition_longitude_deg);
  inspection.range("reposition_altitude_m", clock.reposition_altitude_m, -1'000.0, 200'000.0);
  inspection.range("reposition_heading_deg", clock.reposition_heading_deg, 0.0, 360.0);
  return inspection.result();
}

Refusal why_refused(const RecorderStatus& status) {
  Inspection inspection;
  inspection.range("writing", status.writing, 0, 1);
  inspection.text("problem", status.problem);
  return inspection.result();
}

Refusal why_refused(const PatchMap& map) {
  Inspection inspection;
  inspection.picture_id("id", map.id);
  inspection.range("size", map.size, 1, kMostPatchPixels);
  inspection.latitude("latitude_deg", map.latitude_deg);
  inspection.longitude("longitude_deg", map.longitude_deg);
  inspection.range("elevation_msl_m", map.elevation_msl_m, kLowestGround, kHighestGround);
  inspection.range("up_deg", map.up_deg, 0.0, 360.0);
  inspection.range("window_nm", map.window_nm, kSmallestWindow, kLargestRange);
  inspection.latitude("apex_latitude_deg", map.apex_latitude_deg);
  inspection.longitude("apex_longitude_deg", map.apex_longitude_deg);
  inspection.range("apex_altitude_msl_m", map.apex_altitude_msl_m, -1'000.0, 200'000.0);
  inspection.range("distance_m", map.distance_m, 0.0, kFarthestPatch);
  inspection.range("squint_deg", map.squint_deg, -180.0, 180.0);
  inspection.range("resolution_m", map.resolution_m, 0.0, kFarthestPatch);
  inspection.range("formation_s", map.formation_s, 0.0, kLongestFormation);
  inspection.text("fidelity", map.fidelity);
  return inspection.result();
}

Refusal why_refused(const Traffic& traffic) {
  Inspection inspection;
  inspection.range("count", traffic.count, 0, kMostTraffic);
  const auto count = std::min<std::size_t>(traffic.count, kMostTraffic);
  for (const TrafficEntity& entity : std::span(traffic.entities).first(count)) {
    inspection.latitude("entities.latitude_deg", entity.latitude_deg);
    inspection.longitude("entities.longitude_deg", entity.longitude_deg);
    inspection.speed("entities.velocity_north_mps", entity.velocity_north_mps);
    inspection.speed("entities.velocity_east_mps", entity.velocity_east_mps);
    inspection.range("entities.height_m", entity.height_m, 0.0, kTallestEntity);
    inspection.range("entities.cross_section_m2", entity.cross_section_m2, 0.0, kLargestEcho);
  }
  return inspection.result();
}

Refusal why_refused(const GlassFrame& frame) {
  Inspection inspection;
  inspection.picture_id("id", frame.id);
  inspection.range("width", frame.width, 1, kMostFramePixels);
  inspection.range("height", frame.height, 1, kMostFramePixels);
  return inspection.result();
}

Refusal why_refused(const Outputs& outputs) {
  Inspection inspection;
  inspection.text("target_name", outputs.target_name);
  inspection.range("mark_count", outputs.mark_count, 0, kMarks);
  const auto count = std::min<std::size_t>(outputs.mark_count, kMarks);
  for (const Mark& mark : std::span(outputs.marks).first(count)) {
    inspection.latitude("marks.latitude_deg", mark.latitude_deg);
    inspection.longitude("marks.longitude_deg", mark.longitude_deg);
  }
  inspection.range("steering", outputs.steering, 0, static_cast<int>(SteeringCommand::bank));
  return inspection.result();
}

}  // namespace yars::databuffer
