#include "databuffer/session/record_fields.hpp"

#include <array>

#include "databuffer/session/session_layout.hpp"

namespace yars::databuffer {

namespace {

// offsetof and sizeof need the field's name as a token, and a program needs it as text: only a macro has both.
#define YARS_FIELD(record, field)                          \
  RecordField {                                            \
#field, offsetof(record, field), sizeof(record::field) \
  }

constexpr std::array kClockStateFields = {
    YARS_FIELD(ClockState, base_sim_ns),
    YARS_FIELD(ClockState, base_monotonic_ns),
    YARS_FIELD(ClockState, rate),
    YARS_FIELD(ClockState, running),
    YARS_FIELD(ClockState, epoch),
    YARS_FIELD(ClockState, reposition_latitude_deg),
    YARS_FIELD(ClockState, reposition_longitude_deg),
    YARS_FIELD(ClockState, reposition_altitude_m),
    YARS_FIELD(ClockState, reposition_heading_deg),
    YARS_FIELD(ClockState, followed),
};

constexpr std::array kOwnshipFields = {
    YARS_FIELD(Ownship, source_time_ns),
    YARS_FIELD(Ownship, latitude_deg),
    YARS_FIELD(Ownship, longitude_deg),
    YARS_FIELD(Ownship, altitude_msl_m),
    YARS_FIELD(Ownship, heading_deg),
    YARS_FIELD(Ownship, pitch_deg),
    YARS_FIELD(Ownship, roll_deg),
    YARS_FIELD(Ownship, velocity_north_mps),
    YARS_FIELD(Ownship, velocity_east_mps),
    YARS_FIELD(Ownship, velocity_down_mps),
    YARS_FIELD(Ownship, radar_altitude_m),
    YARS_FIELD(Ownship, epoch),
    YARS_FIELD(Ownship, flags),
    YARS_FIELD(Ownship, source),
    YARS_FIELD(Ownship, flight_time_s),
};

constexpr std::array kNavFields = {
    YARS_FIELD(Nav, source_time_ns),
    YARS_FIELD(Nav, mission_latitude_deg),
    YARS_FIELD(Nav, mission_longitude_deg),
    YARS_FIELD(Nav, ins_latitude_deg),
    YARS_FIELD(Nav, ins_longitude_deg),
    YARS_FIELD(Nav, velocity_north_mps),
    YARS_FIELD(Nav, velocity_east_mps),
    YARS_FIELD(Nav, velocity_down_mps),
    YARS_FIELD(Nav, magnetic_variation_deg),
    YARS_FIELD(Nav, epoch),
    YARS_FIELD(Nav, flags),
};

constexpr std::array kInputEventFields = {
    YARS_FIELD(InputEvent, session_time_ns),
    YARS_FIELD(InputEvent, monotonic_ns),
    YARS_FIELD(InputEvent, x),
    YARS_FIELD(InputEvent, y),
    YARS_FIELD(InputEvent, kind),
    YARS_FIELD(InputEvent, argument),
    YARS_FIELD(InputEvent, number),
    YARS_FIELD(InputEvent, text),
};

constexpr std::array kDrawnPointFields = {
    YARS_FIELD(DrawnPoint, latitude_deg), YARS_FIELD(DrawnPoint, longitude_deg), YARS_FIELD(DrawnPoint, elevation_m),
    YARS_FIELD(DrawnPoint, name),         YARS_FIELD(DrawnPoint, kind),          YARS_FIELD(DrawnPoint, selected),
};

constexpr std::array kNavigatorErrorFields = {
    YARS_FIELD(NavigatorError, north_m),
    YARS_FIELD(NavigatorError, east_m),
    YARS_FIELD(NavigatorError, velocity_north_mps),
    YARS_FIELD(NavigatorError, velocity_east_mps),
    YARS_FIELD(NavigatorError, velocity_down_mps),
};

constexpr std::array kMarkFields = {
    YARS_FIELD(Mark, latitude_deg),
    YARS_FIELD(Mark, longitude_deg),
    YARS_FIELD(Mark, elevation_m),
    YARS_FIELD(Mark, sim_time_ns),
};

constexpr std::array kRadarStateFields = {
    YARS_FIELD(RadarState, tick),
    YARS_FIELD(RadarState, range_nm),
    YARS_FIELD(RadarState, scan_width_deg),
    YARS_FIELD(RadarState, antenna_elevation_deg),
    YARS_FIELD(RadarState, cursor_latitude_deg),
    YARS_FIELD(RadarState, cursor_longitude_deg),
    YARS_FIELD(RadarState, cursor_elevation_m),
    YARS_FIELD(RadarState, cursor_bearing_deg),
    YARS_FIELD(RadarState, cursor_range_nm),
    YARS_FIELD(RadarState, tdc_x),
    YARS_FIELD(RadarState, tdc_y),
    YARS_FIELD(RadarState, window_nm),
    YARS_FIELD(RadarState, events_applied),
    YARS_FIELD(RadarState, epoch),
    YARS_FIELD(RadarState, flags),
    YARS_FIELD(RadarState, scan_restart),
    YARS_FIELD(RadarState, boxed),
    YARS_FIELD(RadarState, power),
    YARS_FIELD(RadarState, mode),
    YARS_FIELD(RadarState, master),
    YARS_FIELD(RadarState, resume_mode),
    YARS_FIELD(RadarState, range_index),
    YARS_FIELD(RadarState, scan),
    YARS_FIELD(RadarState, gain),
    YARS_FIELD(RadarState, brightness),
    YARS_FIELD(RadarState, contrast),
    YARS_FIELD(RadarState, cursor_function),
    YARS_FIELD(RadarState, navigator),
    YARS_FIELD(RadarState, channel),
    YARS_FIELD(RadarState, band),
    YARS_FIELD(RadarState, points_drawn),
    YARS_FIELD(RadarState, window_index),
    YARS_FIELD(RadarState, recall),
    YARS_FIELD(RadarState, sequence_point),
    YARS_FIELD(RadarState, message),
    YARS_FIELD(RadarState, message_until_tick),
    YARS_FIELD(RadarState, points),
    YARS_FIELD(RadarState, legends),
    YARS_FIELD(RadarState, frame_latitude_deg),
    YARS_FIELD(RadarState, frame_longitude_deg),
    YARS_FIELD(RadarState, frame_track_deg),
    YARS_FIELD(RadarState, ground_mode),
    YARS_FIELD(RadarState, map_request),
    YARS_FIELD(RadarState, map_latitude_deg),
    YARS_FIELD(RadarState, map_longitude_deg),
    YARS_FIELD(RadarState, map_window_nm),
    YARS_FIELD(RadarState, map_newest),
    YARS_FIELD(RadarState, map_old),
    YARS_FIELD(RadarState, map_stored),
    YARS_FIELD(RadarState, map_shown),
    YARS_FIELD(RadarState, cursor_believed_latitude_deg),
    YARS_FIELD(RadarState, cursor_believed_longitude_deg),
    YARS_FIELD(RadarState, mission),
    YARS_FIELD(RadarState, ins),
    YARS_FIELD(RadarState, update_north_m),
    YARS_FIELD(RadarState, update_east_m),
    YARS_FIELD(RadarState, cursor_moved_tick),
    YARS_FIELD(RadarState, update_seconds),
    YARS_FIELD(RadarState, vtr_request),
    YARS_FIELD(RadarState, target_latitude_deg),
    YARS_FIELD(RadarState, target_longitude_deg),
    YARS_FIELD(RadarState, target_elevation_m),
    YARS_FIELD(RadarState, target_name),
    YARS_FIELD(RadarState, steering_line_deg),
    YARS_FIELD(RadarState, cue_latitude_deg),
    YARS_FIELD(RadarState, cue_longitude_deg),
    YARS_FIELD(RadarState, cue_elevation_m),
    YARS_FIELD(RadarState, cue_count),
    YARS_FIELD(RadarState, target_count),
    YARS_FIELD(RadarState, steering_line),
    YARS_FIELD(RadarState, mark_count),
    YARS_FIELD(RadarState, velocity_taken),
    YARS_FIELD(RadarState, velocity_updated_tick),
    YARS_FIELD(RadarState, velocity_shown_until_tick),
    YARS_FIELD(RadarState, velocity_along_mps),
    YARS_FIELD(RadarState, velocity_across_mps),
    YARS_FIELD(RadarState, velocity_vertical_mps),
    YARS_FIELD(RadarState, marks),
    YARS_FIELD(RadarState, magnetic_variation_deg),
    YARS_FIELD(RadarState, asked_latitude_deg),
    YARS_FIELD(RadarState, asked_longitude_deg),
    YARS_FIELD(RadarState, asked_tick),
    YARS_FIELD(RadarState, asked_for),
};

constexpr std::array kRadarCommandFields = {
    YARS_FIELD(RadarCommand, range_nm),
    YARS_FIELD(RadarCommand, scan_width_deg),
    YARS_FIELD(RadarCommand, antenna_elevation_deg),
    YARS_FIELD(RadarCommand, cursor_latitude_deg),
    YARS_FIELD(RadarCommand, cursor_longitude_deg),
    YARS_FIELD(RadarCommand, window_nm),
    YARS_FIELD(RadarCommand, scan_restart),
    YARS_FIELD(RadarCommand, flags),
    YARS_FIELD(RadarCommand, power),
    YARS_FIELD(RadarCommand, mode),
    YARS_FIELD(RadarCommand, scan),
    YARS_FIELD(RadarCommand, gain),
    YARS_FIELD(RadarCommand, range_index),
    YARS_FIELD(RadarCommand, channel),
    YARS_FIELD(RadarCommand, band),
    YARS_FIELD(RadarCommand, map_latitude_deg),
    YARS_FIELD(RadarCommand, map_longitude_deg),
    YARS_FIELD(RadarCommand, map_window_nm),
    YARS_FIELD(RadarCommand, map_request),
};

constexpr std::array kModelTickFields = {
    YARS_FIELD(ModelTick, tick),     YARS_FIELD(ModelTick, sim_time_ns),        YARS_FIELD(ModelTick, ownship),
    YARS_FIELD(ModelTick, command),  YARS_FIELD(ModelTick, terrain_generation), YARS_FIELD(ModelTick, epoch),
    YARS_FIELD(ModelTick, flags),    YARS_FIELD(ModelTick, ownship_lane),       YARS_FIELD(ModelTick, samples),
    YARS_FIELD(ModelTick, fidelity), YARS_FIELD(ModelTick, resumed_tick),       YARS_FIELD(ModelTick, traffic),
};

constexpr std::array kAppliedEventFields = {
    YARS_FIELD(AppliedEvent, tick), YARS_FIELD(AppliedEvent, monotonic_ns), YARS_FIELD(AppliedEvent, event),
    YARS_FIELD(AppliedEvent, lane), YARS_FIELD(AppliedEvent, effective),
};

constexpr std::array kSweepFields = {
    YARS_FIELD(Sweep, tick),
    YARS_FIELD(Sweep, sim_time_ns),
    YARS_FIELD(Sweep, apex_latitude_deg),
    YARS_FIELD(Sweep, apex_longitude_deg),
    YARS_FIELD(Sweep, apex_altitude_msl_m),
    YARS_FIELD(Sweep, azimuth_left_deg),
    YARS_FIELD(Sweep, azimuth_right_deg),
    YARS_FIELD(Sweep, ground_track_deg),
    YARS_FIELD(Sweep, elevation_deg),
    YARS_FIELD(Sweep, range_m),
    YARS_FIELD(Sweep, hash),
    YARS_FIELD(Sweep, epoch),
    YARS_FIELD(Sweep, scan),
    YARS_FIELD(Sweep, number),
    YARS_FIELD(Sweep, samples),
    YARS_FIELD(Sweep, flags),
    YARS_FIELD(Sweep, mode),
    YARS_FIELD(Sweep, gain),
    YARS_FIELD(Sweep, direction),
    YARS_FIELD(Sweep, video),
};

constexpr std::array kModelStatusFields = {
    YARS_FIELD(ModelStatus, tick),
    YARS_FIELD(ModelStatus, sim_time_ns),
    YARS_FIELD(ModelStatus, antenna_azimuth_deg),
    YARS_FIELD(ModelStatus, antenna_elevation_deg),
    YARS_FIELD(ModelStatus, height_above_ground_m),
    YARS_FIELD(ModelStatus, ground_elevation_m),
    YARS_FIELD(ModelStatus, cursor_ground_elevation_m),
    YARS_FIELD(ModelStatus, map_timer_s),
    YARS_FIELD(ModelStatus, map_progress),
    YARS_FIELD(ModelStatus, load),
    YARS_FIELD(ModelStatus, terrain_generation),
    YARS_FIELD(ModelStatus, terrain_bytes),
    YARS_FIELD(ModelStatus, sweeps),
    YARS_FIELD(ModelStatus, late_ticks),
    YARS_FIELD(ModelStatus, refused),
    YARS_FIELD(ModelStatus, posts_pending),
    YARS_FIELD(ModelStatus, epoch),
    YARS_FIELD(ModelStatus, scan),
    YARS_FIELD(ModelStatus, sweep),
    YARS_FIELD(ModelStatus, flags),
    YARS_FIELD(ModelStatus, scan_restart),
    YARS_FIELD(ModelStatus, ownship_lane),
    YARS_FIELD(ModelStatus, scan_direction),
    YARS_FIELD(ModelStatus, mode),
    YARS_FIELD(ModelStatus, scan_bar),
    YARS_FIELD(ModelStatus, mappable),
    YARS_FIELD(ModelStatus, why_not),
    YARS_FIELD(ModelStatus, fidelity),
    YARS_FIELD(ModelStatus, ownship),
    YARS_FIELD(ModelStatus, nav),
    YARS_FIELD(ModelStatus, scan_centre_deg),
    YARS_FIELD(ModelStatus, scan_width_deg),
    YARS_FIELD(ModelStatus, scan_range_m),
    YARS_FIELD(ModelStatus, scan_tick),
    YARS_FIELD(ModelStatus, antenna_phase),
    YARS_FIELD(ModelStatus, scan_noise_only),
    YARS_FIELD(ModelStatus, ownship_received_ns),
    YARS_FIELD(ModelStatus, map_latitude_deg),
    YARS_FIELD(ModelStatus, map_longitude_deg),
    YARS_FIELD(ModelStatus, map_up_deg),
    YARS_FIELD(ModelStatus, map_window_nm),
    YARS_FIELD(ModelStatus, map_newest),
    YARS_FIELD(ModelStatus, map_request),
    YARS_FIELD(ModelStatus, map_done_request),
    YARS_FIELD(ModelStatus, scan_offset_deg),
    YARS_FIELD(ModelStatus, scan_rate_dps),
    YARS_FIELD(ModelStatus, velocity_north_mps),
    YARS_FIELD(ModelStatus, velocity_east_mps),
    YARS_FIELD(ModelStatus, velocity_down_mps),
    YARS_FIELD(ModelStatus, velocity_due_tick),
    YARS_FIELD(ModelStatus, velocity_count),
    YARS_FIELD(ModelStatus, velocity_dwell),
    YARS_FIELD(ModelStatus, velocity_beam),
    YARS_FIELD(ModelStatus, answered_latitude_deg),
    YARS_FIELD(ModelStatus, answered_longitude_deg),
    YARS_FIELD(ModelStatus, answered_elevation_m),
    YARS_FIELD(ModelStatus, map_stopped),
};

constexpr std::array kOutputsFields = {
    YARS_FIELD(Outputs, tick),
    YARS_FIELD(Outputs, sim_time_ns),
    YARS_FIELD(Outputs, cue_latitude_deg),
    YARS_FIELD(Outputs, cue_longitude_deg),
    YARS_FIELD(Outputs, cue_elevation_m),
    YARS_FIELD(Outputs, target_latitude_deg),
    YARS_FIELD(Outputs, target_longitude_deg),
    YARS_FIELD(Outputs, target_elevation_m),
    YARS_FIELD(Outputs, target_name),
    YARS_FIELD(Outputs, slant_range_m),
    YARS_FIELD(Outputs, bearing_deg),
    YARS_FIELD(Outputs, depression_deg),
    YARS_FIELD(Outputs, steering_deg),
    YARS_FIELD(Outputs, approach_deg),
    YARS_FIELD(Outputs, epoch),
    YARS_FIELD(Outputs, cue_count),
    YARS_FIELD(Outputs, target_count),
    YARS_FIELD(Outputs, steering),
    YARS_FIELD(Outputs, mark_count),
    YARS_FIELD(Outputs, marks),
};

constexpr std::array kRecorderStatusFields = {
    YARS_FIELD(RecorderStatus, tick),    YARS_FIELD(RecorderStatus, sim_time_ns), YARS_FIELD(RecorderStatus, bytes),
    YARS_FIELD(RecorderStatus, writing), YARS_FIELD(RecorderStatus, vtr_request), YARS_FIELD(RecorderStatus, problem),
};

constexpr std::array kPatchMapFields = {
    YARS_FIELD(PatchMap, id),
    YARS_FIELD(PatchMap, start_tick),
    YARS_FIELD(PatchMap, end_tick),
    YARS_FIELD(PatchMap, latitude_deg),
    YARS_FIELD(PatchMap, longitude_deg),
    YARS_FIELD(PatchMap, elevation_msl_m),
    YARS_FIELD(PatchMap, up_deg),
    YARS_FIELD(PatchMap, window_nm),
    YARS_FIELD(PatchMap, apex_latitude_deg),
    YARS_FIELD(PatchMap, apex_longitude_deg),
    YARS_FIELD(PatchMap, apex_altitude_msl_m),
    YARS_FIELD(PatchMap, distance_m),
    YARS_FIELD(PatchMap, squint_deg),
    YARS_FIELD(PatchMap, resolution_m),
    YARS_FIELD(PatchMap, formation_s),
    YARS_FIELD(PatchMap, hash),
    YARS_FIELD(PatchMap, epoch),
    YARS_FIELD(PatchMap, request),
    YARS_FIELD(PatchMap, size),
    YARS_FIELD(PatchMap, looks),
    YARS_FIELD(PatchMap, flags),
    YARS_FIELD(PatchMap, fidelity),
};

constexpr std::array kTrafficEntityFields = {
    YARS_FIELD(TrafficEntity, latitude_deg),
    YARS_FIELD(TrafficEntity, longitude_deg),
    YARS_FIELD(TrafficEntity, velocity_north_mps),
    YARS_FIELD(TrafficEntity, velocity_east_mps),
    YARS_FIELD(TrafficEntity, height_m),
    YARS_FIELD(TrafficEntity, cross_section_m2),
    YARS_FIELD(TrafficEntity, id),
};

constexpr std::array kTrafficFields = {
    YARS_FIELD(Traffic, tick),  YARS_FIELD(Traffic, source_time_ns), YARS_FIELD(Traffic, count),
    YARS_FIELD(Traffic, epoch), YARS_FIELD(Traffic, entities),
};

constexpr std::array kGlassFrameFields = {
    YARS_FIELD(GlassFrame, id),    YARS_FIELD(GlassFrame, tick),   YARS_FIELD(GlassFrame, sim_time_ns),
    YARS_FIELD(GlassFrame, width), YARS_FIELD(GlassFrame, height),
};

constexpr std::array kNoteFields = {
    YARS_FIELD(Note, monotonic_ns), YARS_FIELD(Note, sim_time_ns), YARS_FIELD(Note, pid),
    YARS_FIELD(Note, kind),         YARS_FIELD(Note, process),     YARS_FIELD(Note, text),
};

#undef YARS_FIELD

constexpr std::array kRecords = {
    RecordFields{"ClockState", sizeof(ClockState), kClockStateFields},
    RecordFields{"Ownship", sizeof(Ownship), kOwnshipFields},
    RecordFields{"Nav", sizeof(Nav), kNavFields},
    RecordFields{"InputEvent", sizeof(InputEvent), kInputEventFields},
    RecordFields{"DrawnPoint", sizeof(DrawnPoint), kDrawnPointFields},
    RecordFields{"NavigatorError", sizeof(NavigatorError), kNavigatorErrorFields},
    RecordFields{"Mark", sizeof(Mark), kMarkFields},
    RecordFields{"RadarState", sizeof(RadarState), kRadarStateFields},
    RecordFields{"RadarCommand", sizeof(RadarCommand), kRadarCommandFields},
    RecordFields{"ModelTick", sizeof(ModelTick), kModelTickFields},
    RecordFields{"AppliedEvent", sizeof(AppliedEvent), kAppliedEventFields},
    RecordFields{"Sweep", sizeof(Sweep), kSweepFields},
    RecordFields{"ModelStatus", sizeof(ModelStatus), kModelStatusFields},
    RecordFields{"Outputs", sizeof(Outputs), kOutputsFields},
    RecordFields{"RecorderStatus", sizeof(RecorderStatus), kRecorderStatusFields},
    RecordFields{"PatchMap", sizeof(PatchMap), kPatchMapFields},
    RecordFields{"TrafficEntity", sizeof(TrafficEntity), kTrafficEntityFields},
    RecordFields{"Traffic", sizeof(Traffic), kTrafficFields},
    RecordFields{"GlassFrame", sizeof(GlassFrame), kGlassFrameFields},
    RecordFields{"Note", sizeof(Note), kNoteFields},
};

}  // namespace

std::span<const RecordFields> record_fields() {
  return kRecords;
}

}  // namespace yars::databuffer
