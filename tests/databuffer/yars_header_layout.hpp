// databuffer/yars.h against the C++ records, word by word at compile time. An assertion that breaks here means: the
// layout has changed, so change yars.h with it (`yars status --layout` prints the numbers).
#pragma once

#include "databuffer/layout_identity.hpp"
#include "databuffer/session.hpp"
#include "databuffer/yars.h"

namespace yars::databuffer {

static_assert(YARS_MAGIC == shm::kSegmentMagic && YARS_LAYOUT_VERSION == kLayoutVersion);
static_assert(YARS_LAYOUT_SIZE == kLayoutIdentity.size);
static_assert(YARS_LAYOUT_HASH == kLayoutIdentity.hash);
static_assert(YARS_AT_CLOCK == offsetof(SessionLayout, clock));
static_assert(YARS_AT_OWNSHIP_PRIORITY == offsetof(SessionLayout, ownship_priority));
static_assert(YARS_AT_OWNSHIP == offsetof(SessionLayout, ownship));
static_assert(YARS_AT_NAV == offsetof(SessionLayout, nav));
static_assert(YARS_AT_RADAR_STATE == offsetof(SessionLayout, radar_state));
static_assert(YARS_AT_MODEL_STATUS == offsetof(SessionLayout, model_status));
static_assert(YARS_AT_OUTPUTS == offsetof(SessionLayout, outputs));
static_assert(YARS_AT_INPUT == offsetof(SessionLayout, input));
static_assert(YARS_AT_PROCESSES == offsetof(SessionLayout, processes));
static_assert(YARS_AT_TRAFFIC == offsetof(SessionLayout, traffic) && YARS_AT_FRAMES == offsetof(SessionLayout, frames));
static_assert(YARS_FRAMES == kFrameSlots && YARS_FRAME_STRIDE == sizeof(FrameSlot) && offsetof(FrameSlot, id) == 0);
static_assert(YARS_FRAME_WORDS == offsetof(FrameSlot, frame) && YARS_FRAME_PIXELS == offsetof(FrameSlot, pixels));
static_assert(YARS_MOST_FRAME_BYTES == sizeof(FrameSlot::pixels));
static_assert(YARS_TRAFFIC_BYTE == static_cast<int>(Role::traffic));
static_assert(offsetof(shm::SegmentHeader, magic) == 0 && offsetof(shm::SegmentHeader, size) == 8);
static_assert(offsetof(shm::SegmentHeader, hash) == 16 && offsetof(shm::SegmentHeader, layout_version) == 24);
static_assert(offsetof(shm::SegmentHeader, holder_pid) == 32);
static_assert(offsetof(ProcessEntry, heartbeat_ns) == 0 && offsetof(ProcessEntry, pid) == 8);
static_assert(offsetof(ProcessEntry, name) == 16 && sizeof(ProcessEntry) == 40);

static_assert(YARS_FIRST_OWNSHIP_BYTE == kFirstOwnshipByte && YARS_OWNSHIP_LANES == kOwnshipLanes);
static_assert(YARS_FIRST_INPUT_BYTE == kFirstInputByte && YARS_INPUT_LANES == kInputLanes);
static_assert(YARS_FIRST_PROCESS_BYTE == kFirstProcessByte && YARS_PROCESSES == kProcesses);

template <class Record>
constexpr bool kValueMatches =
    shm::LatestValue<Record>::state_offset() == 0 &&
    shm::LatestValue<Record>::slots_offset() == YARS_LINE&& shm::LatestValue<Record>::slot_stride() ==
        YARS_SLOT_STRIDE(sizeof(Record)) &&
    shm::LatestValue<Record>::kSlots == YARS_SLOTS &&
    sizeof(shm::LatestValue<Record>) == YARS_VALUE_SIZE(sizeof(Record));
static_assert(kValueMatches<ClockState> && kValueMatches<Ownship> && kValueMatches<Nav>);
static_assert(kValueMatches<RadarState> && kValueMatches<ModelStatus> && kValueMatches<Outputs> &&
              kValueMatches<Traffic>);

using Input = decltype(SessionLayout::input);
static_assert(Input::lane_stride() == YARS_INPUT_STRIDE && Input::kDepth == YARS_INPUT_DEPTH);
static_assert(Input::pushed_offset() == 0 && Input::dropped_offset() == YARS_INPUT_DROPPED);
static_assert(Input::source_offset() == YARS_INPUT_SOURCE && Input::popped_offset() == YARS_INPUT_POPPED);
static_assert(Input::records_offset() == YARS_INPUT_RECORDS);

// Same place and same type (an enumeration or a record of its own may stand for another of its size).
#define SAME(c_record, record, field)                                   \
  static_assert(offsetof(c_record, field) == offsetof(record, field) && \
                sizeof(c_record::field) == sizeof(record::field))

static_assert(sizeof(yars_clock) == sizeof(ClockState));
SAME(yars_clock, ClockState, base_sim_ns);
SAME(yars_clock, ClockState, base_monotonic_ns);
SAME(yars_clock, ClockState, rate);
SAME(yars_clock, ClockState, running);
SAME(yars_clock, ClockState, epoch);
SAME(yars_clock, ClockState, reposition_latitude_deg);
SAME(yars_clock, ClockState, reposition_longitude_deg);
SAME(yars_clock, ClockState, reposition_altitude_m);
SAME(yars_clock, ClockState, reposition_heading_deg);
SAME(yars_clock, ClockState, followed);
SAME(yars_clock, ClockState, reserved);
static_assert(sizeof(yars_ownship) == sizeof(Ownship));
SAME(yars_ownship, Ownship, source_time_ns);
SAME(yars_ownship, Ownship, latitude_deg);
SAME(yars_ownship, Ownship, longitude_deg);
SAME(yars_ownship, Ownship, altitude_msl_m);
SAME(yars_ownship, Ownship, heading_deg);
SAME(yars_ownship, Ownship, pitch_deg);
SAME(yars_ownship, Ownship, roll_deg);
SAME(yars_ownship, Ownship, velocity_north_mps);
SAME(yars_ownship, Ownship, velocity_east_mps);
SAME(yars_ownship, Ownship, velocity_down_mps);
SAME(yars_ownship, Ownship, radar_altitude_m);
SAME(yars_ownship, Ownship, epoch);
SAME(yars_ownship, Ownship, flags);
SAME(yars_ownship, Ownship, source);
SAME(yars_ownship, Ownship, reserved);
static_assert(sizeof(yars_nav) == sizeof(Nav));
SAME(yars_nav, Nav, source_time_ns);
SAME(yars_nav, Nav, mission_latitude_deg);
SAME(yars_nav, Nav, mission_longitude_deg);
SAME(yars_nav, Nav, ins_latitude_deg);
SAME(yars_nav, Nav, ins_longitude_deg);
SAME(yars_nav, Nav, velocity_north_mps);
SAME(yars_nav, Nav, velocity_east_mps);
SAME(yars_nav, Nav, velocity_down_mps);
SAME(yars_nav, Nav, magnetic_variation_deg);
SAME(yars_nav, Nav, epoch);
SAME(yars_nav, Nav, flags);
SAME(yars_nav, Nav, reserved);
static_assert(sizeof(yars_traffic_entity) == sizeof(TrafficEntity));
SAME(yars_traffic_entity, TrafficEntity, latitude_deg);
SAME(yars_traffic_entity, TrafficEntity, longitude_deg);
SAME(yars_traffic_entity, TrafficEntity, velocity_north_mps);
SAME(yars_traffic_entity, TrafficEntity, velocity_east_mps);
SAME(yars_traffic_entity, TrafficEntity, height_m);
SAME(yars_traffic_entity, TrafficEntity, cross_section_m2);
SAME(yars_traffic_entity, TrafficEntity, id);
SAME(yars_traffic_entity, TrafficEntity, reserved0);
static_assert(sizeof(yars_traffic) == sizeof(Traffic));
SAME(yars_traffic, Traffic, tick);
SAME(yars_traffic, Traffic, source_time_ns);
SAME(yars_traffic, Traffic, count);
SAME(yars_traffic, Traffic, epoch);
SAME(yars_traffic, Traffic, reserved);
SAME(yars_traffic, Traffic, entities);
static_assert(sizeof(yars_glass_frame) == sizeof(GlassFrame));
SAME(yars_glass_frame, GlassFrame, id);
SAME(yars_glass_frame, GlassFrame, tick);
SAME(yars_glass_frame, GlassFrame, sim_time_ns);
SAME(yars_glass_frame, GlassFrame, width);
SAME(yars_glass_frame, GlassFrame, height);
SAME(yars_glass_frame, GlassFrame, reserved);
static_assert(sizeof(yars_input_event) == sizeof(InputEvent));
SAME(yars_input_event, InputEvent, session_time_ns);
SAME(yars_input_event, InputEvent, monotonic_ns);
SAME(yars_input_event, InputEvent, x);
SAME(yars_input_event, InputEvent, y);
SAME(yars_input_event, InputEvent, kind);
SAME(yars_input_event, InputEvent, argument);
SAME(yars_input_event, InputEvent, number);
SAME(yars_input_event, InputEvent, text);
static_assert(sizeof(yars_drawn_point) == sizeof(DrawnPoint));
SAME(yars_drawn_point, DrawnPoint, latitude_deg);
SAME(yars_drawn_point, DrawnPoint, longitude_deg);
SAME(yars_drawn_point, DrawnPoint, elevation_m);
SAME(yars_drawn_point, DrawnPoint, name);
SAME(yars_drawn_point, DrawnPoint, kind);
SAME(yars_drawn_point, DrawnPoint, selected);
SAME(yars_drawn_point, DrawnPoint, reserved);
static_assert(sizeof(yars_radar_state) == sizeof(RadarState));
SAME(yars_radar_state, RadarState, tick);
SAME(yars_radar_state, RadarState, range_nm);
SAME(yars_radar_state, RadarState, scan_width_deg);
SAME(yars_radar_state, RadarState, antenna_elevation_deg);
SAME(yars_radar_state, RadarState, cursor_latitude_deg);
SAME(yars_radar_state, RadarState, cursor_longitude_deg);
SAME(yars_radar_state, RadarState, cursor_elevation_m);
SAME(yars_radar_state, RadarState, cursor_bearing_deg);
SAME(yars_radar_state, RadarState, cursor_range_nm);
SAME(yars_radar_state, RadarState, tdc_x);
SAME(yars_radar_state, RadarState, tdc_y);
SAME(yars_radar_state, RadarState, window_nm);
SAME(yars_radar_state, RadarState, events_applied);
SAME(yars_radar_state, RadarState, epoch);
SAME(yars_radar_state, RadarState, flags);
SAME(yars_radar_state, RadarState, scan_restart);
SAME(yars_radar_state, RadarState, boxed);
SAME(yars_radar_state, RadarState, power);
SAME(yars_radar_state, RadarState, mode);
SAME(yars_radar_state, RadarState, master);
SAME(yars_radar_state, RadarState, resume_mode);
SAME(yars_radar_state, RadarState, range_index);
SAME(yars_radar_state, RadarState, scan);
SAME(yars_radar_state, RadarState, gain);
SAME(yars_radar_state, RadarState, brightness);
SAME(yars_radar_state, RadarState, contrast);
SAME(yars_radar_state, RadarState, cursor_function);
SAME(yars_radar_state, RadarState, navigator);
SAME(yars_radar_state, RadarState, channel);
SAME(yars_radar_state, RadarState, band);
SAME(yars_radar_state, RadarState, points_drawn);
SAME(yars_radar_state, RadarState, window_index);
SAME(yars_radar_state, RadarState, recall);
SAME(yars_radar_state, RadarState, sequence_point);
SAME(yars_radar_state, RadarState, message);
SAME(yars_radar_state, RadarState, message_until_tick);
SAME(yars_radar_state, RadarState, points);
SAME(yars_radar_state, RadarState, legends);
SAME(yars_radar_state, RadarState, frame_latitude_deg);
SAME(yars_radar_state, RadarState, frame_longitude_deg);
SAME(yars_radar_state, RadarState, frame_track_deg);
SAME(yars_radar_state, RadarState, ground_mode);
SAME(yars_radar_state, RadarState, reserved_bytes);
SAME(yars_radar_state, RadarState, map_request);
SAME(yars_radar_state, RadarState, map_latitude_deg);
SAME(yars_radar_state, RadarState, map_longitude_deg);
SAME(yars_radar_state, RadarState, map_window_nm);
SAME(yars_radar_state, RadarState, map_newest);
SAME(yars_radar_state, RadarState, map_old);
SAME(yars_radar_state, RadarState, map_stored);
SAME(yars_radar_state, RadarState, map_shown);
SAME(yars_radar_state, RadarState, cursor_believed_latitude_deg);
SAME(yars_radar_state, RadarState, cursor_believed_longitude_deg);
SAME(yars_radar_state, RadarState, mission);
SAME(yars_radar_state, RadarState, ins);
SAME(yars_radar_state, RadarState, update_north_m);
SAME(yars_radar_state, RadarState, update_east_m);
SAME(yars_radar_state, RadarState, cursor_moved_tick);
SAME(yars_radar_state, RadarState, update_seconds);
SAME(yars_radar_state, RadarState, vtr_request);
SAME(yars_radar_state, RadarState, target_latitude_deg);
SAME(yars_radar_state, RadarState, target_longitude_deg);
SAME(yars_radar_state, RadarState, target_elevation_m);
SAME(yars_radar_state, RadarState, target_name);
SAME(yars_radar_state, RadarState, steering_line_deg);
SAME(yars_radar_state, RadarState, cue_latitude_deg);
SAME(yars_radar_state, RadarState, cue_longitude_deg);
SAME(yars_radar_state, RadarState, cue_elevation_m);
SAME(yars_radar_state, RadarState, cue_count);
SAME(yars_radar_state, RadarState, target_count);
SAME(yars_radar_state, RadarState, steering_line);
SAME(yars_radar_state, RadarState, mark_count);
SAME(yars_radar_state, RadarState, velocity_taken);
SAME(yars_radar_state, RadarState, velocity_updated_tick);
SAME(yars_radar_state, RadarState, velocity_shown_until_tick);
SAME(yars_radar_state, RadarState, velocity_along_mps);
SAME(yars_radar_state, RadarState, velocity_across_mps);
SAME(yars_radar_state, RadarState, velocity_vertical_mps);
SAME(yars_radar_state, RadarState, marks);
SAME(yars_radar_state, RadarState, magnetic_variation_deg);
SAME(yars_radar_state, RadarState, reserved_bytes2);
SAME(yars_radar_state, RadarState, reserved);
static_assert(sizeof(yars_model_status) == sizeof(ModelStatus));
SAME(yars_model_status, ModelStatus, tick);
SAME(yars_model_status, ModelStatus, sim_time_ns);
SAME(yars_model_status, ModelStatus, antenna_azimuth_deg);
SAME(yars_model_status, ModelStatus, antenna_elevation_deg);
SAME(yars_model_status, ModelStatus, height_above_ground_m);
SAME(yars_model_status, ModelStatus, ground_elevation_m);
SAME(yars_model_status, ModelStatus, cursor_ground_elevation_m);
SAME(yars_model_status, ModelStatus, map_timer_s);
SAME(yars_model_status, ModelStatus, map_progress);
SAME(yars_model_status, ModelStatus, load);
SAME(yars_model_status, ModelStatus, terrain_generation);
SAME(yars_model_status, ModelStatus, terrain_bytes);
SAME(yars_model_status, ModelStatus, sweeps);
SAME(yars_model_status, ModelStatus, late_ticks);
SAME(yars_model_status, ModelStatus, refused);
SAME(yars_model_status, ModelStatus, posts_pending);
SAME(yars_model_status, ModelStatus, epoch);
SAME(yars_model_status, ModelStatus, scan);
SAME(yars_model_status, ModelStatus, sweep);
SAME(yars_model_status, ModelStatus, flags);
SAME(yars_model_status, ModelStatus, scan_restart);
SAME(yars_model_status, ModelStatus, ownship_lane);
SAME(yars_model_status, ModelStatus, scan_direction);
SAME(yars_model_status, ModelStatus, mode);
SAME(yars_model_status, ModelStatus, scan_bar);
SAME(yars_model_status, ModelStatus, mappable);
SAME(yars_model_status, ModelStatus, why_not);
SAME(yars_model_status, ModelStatus, fidelity);
SAME(yars_model_status, ModelStatus, ownship);
SAME(yars_model_status, ModelStatus, nav);
SAME(yars_model_status, ModelStatus, scan_centre_deg);
SAME(yars_model_status, ModelStatus, scan_width_deg);
SAME(yars_model_status, ModelStatus, scan_range_m);
SAME(yars_model_status, ModelStatus, scan_tick);
SAME(yars_model_status, ModelStatus, antenna_phase);
SAME(yars_model_status, ModelStatus, scan_noise_only);
SAME(yars_model_status, ModelStatus, reserved0);
SAME(yars_model_status, ModelStatus, map_latitude_deg);
SAME(yars_model_status, ModelStatus, map_longitude_deg);
SAME(yars_model_status, ModelStatus, map_up_deg);
SAME(yars_model_status, ModelStatus, map_window_nm);
SAME(yars_model_status, ModelStatus, map_newest);
SAME(yars_model_status, ModelStatus, map_request);
SAME(yars_model_status, ModelStatus, map_done_request);
SAME(yars_model_status, ModelStatus, scan_offset_deg);
SAME(yars_model_status, ModelStatus, scan_rate_dps);
SAME(yars_model_status, ModelStatus, velocity_north_mps);
SAME(yars_model_status, ModelStatus, velocity_east_mps);
SAME(yars_model_status, ModelStatus, velocity_down_mps);
SAME(yars_model_status, ModelStatus, velocity_due_tick);
SAME(yars_model_status, ModelStatus, velocity_count);
SAME(yars_model_status, ModelStatus, velocity_dwell);
SAME(yars_model_status, ModelStatus, velocity_beam);
SAME(yars_model_status, ModelStatus, reserved_bytes);
SAME(yars_model_status, ModelStatus, reserved);

static_assert(sizeof(yars_outputs) == sizeof(Outputs));
SAME(yars_outputs, Outputs, tick);
SAME(yars_outputs, Outputs, sim_time_ns);
SAME(yars_outputs, Outputs, cue_latitude_deg);
SAME(yars_outputs, Outputs, cue_longitude_deg);
SAME(yars_outputs, Outputs, cue_elevation_m);
SAME(yars_outputs, Outputs, target_latitude_deg);
SAME(yars_outputs, Outputs, target_longitude_deg);
SAME(yars_outputs, Outputs, target_elevation_m);
SAME(yars_outputs, Outputs, target_name);
SAME(yars_outputs, Outputs, slant_range_m);
SAME(yars_outputs, Outputs, bearing_deg);
SAME(yars_outputs, Outputs, depression_deg);
SAME(yars_outputs, Outputs, steering_deg);
SAME(yars_outputs, Outputs, approach_deg);
SAME(yars_outputs, Outputs, epoch);
SAME(yars_outputs, Outputs, cue_count);
SAME(yars_outputs, Outputs, target_count);
SAME(yars_outputs, Outputs, steering);
SAME(yars_outputs, Outputs, mark_count);
SAME(yars_outputs, Outputs, marks);

static_assert(sizeof(yars_navigator_error) == sizeof(NavigatorError));
SAME(yars_navigator_error, NavigatorError, north_m);
SAME(yars_navigator_error, NavigatorError, east_m);
SAME(yars_navigator_error, NavigatorError, velocity_north_mps);
SAME(yars_navigator_error, NavigatorError, velocity_east_mps);
SAME(yars_navigator_error, NavigatorError, velocity_down_mps);

static_assert(sizeof(yars_mark) == sizeof(Mark));
SAME(yars_mark, Mark, latitude_deg);
SAME(yars_mark, Mark, longitude_deg);
SAME(yars_mark, Mark, elevation_m);
SAME(yars_mark, Mark, sim_time_ns);

static_assert(YARS_AT_SWEEPS == offsetof(SessionLayout, sweeps));
static_assert(YARS_LINE == decltype(SessionLayout::sweeps)::slots_offset());
static_assert(YARS_SWEEPS == decltype(SessionLayout::sweeps)::kDepth);
static_assert(YARS_SWEEP_STRIDE == decltype(SessionLayout::sweeps)::slot_stride());
static_assert(YARS_MOST_SAMPLES == radar::kMaxSamples);
static_assert(YARS_RADAR_MODEL_BYTE == static_cast<int>(Role::radar_model));
static_assert(YARS_STATE_MACHINE_BYTE == static_cast<int>(Role::state_machine));
static_assert(sizeof(yars_sweep) == sizeof(Sweep));
SAME(yars_sweep, Sweep, tick);
SAME(yars_sweep, Sweep, sim_time_ns);
SAME(yars_sweep, Sweep, apex_latitude_deg);
SAME(yars_sweep, Sweep, apex_longitude_deg);
SAME(yars_sweep, Sweep, apex_altitude_msl_m);
SAME(yars_sweep, Sweep, azimuth_left_deg);
SAME(yars_sweep, Sweep, azimuth_right_deg);
SAME(yars_sweep, Sweep, ground_track_deg);
SAME(yars_sweep, Sweep, elevation_deg);
SAME(yars_sweep, Sweep, range_m);
SAME(yars_sweep, Sweep, hash);
SAME(yars_sweep, Sweep, epoch);
SAME(yars_sweep, Sweep, scan);
SAME(yars_sweep, Sweep, number);
SAME(yars_sweep, Sweep, samples);
SAME(yars_sweep, Sweep, flags);
SAME(yars_sweep, Sweep, mode);
SAME(yars_sweep, Sweep, gain);
SAME(yars_sweep, Sweep, direction);
SAME(yars_sweep, Sweep, reserved0);
SAME(yars_sweep, Sweep, reserved);
SAME(yars_sweep, Sweep, video);

#undef SAME

}  // namespace yars::databuffer
