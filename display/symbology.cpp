#include "display/symbology.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "databuffer/records/map_timer.hpp"
#include "databuffer/records/navigation.hpp"
#include "display/markers.hpp"
#include "display/present_frame.hpp"
#include "display/readouts.hpp"
#include "display/scales.hpp"
#include "display/steering_line.hpp"
#include "display/velocity_readouts.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

namespace {

// A row of the table: what the format of a mode has.
struct Format {
  bool video = false;  // sweeps
  bool map = false;    // a patch map
  bool arcs = false;
  bool zero_line = false;
  bool scales = false;       // azimuth and elevation scale, carets, pitch ball
  bool limit_balls = false;  // on the azimuth scale
  bool gray_scale = false;
  bool ground = false;  // cursor with its readout, sequence points
  bool window_size = false;
  bool mapping = false;   // outline and timer of a map
  bool readouts = false;  // range, brightness
  bool velocity = false;  // differences of velocity and the beam under way
};

constexpr Format kRbm{.video = true,
                      .arcs = true,
                      .zero_line = true,
                      .scales = true,
                      .gray_scale = true,
                      .ground = true,
                      .window_size = true,
                      .mapping = true,
                      .readouts = true};
constexpr Format kHrm{.video = true,
                      .arcs = true,
                      .scales = true,
                      .limit_balls = true,
                      .gray_scale = true,
                      .ground = true,
                      .window_size = true,
                      .mapping = true,
                      .readouts = true};
constexpr Format kPatch{.map = true,
                        .scales = true,
                        .limit_balls = true,
                        .ground = true,
                        .window_size = true,
                        .mapping = true,
                        .readouts = true};
// Over which A/A or ranging has the radar: no map is made.
constexpr Format kStandingMap{.map = true, .scales = true, .limit_balls = true, .ground = true, .readouts = true};
constexpr Format kBeacon{.video = true,
                         .arcs = true,
                         .zero_line = true,
                         .scales = true,
                         .ground = true,
                         .window_size = true,
                         .readouts = true};
constexpr Format kPvu{.scales = true, .window_size = true, .mapping = true, .readouts = true, .velocity = true};
constexpr Format kLegendsOnly{};

const Format& format_of(const databuffer::RadarState& state) {
  switch (static_cast<radar::Mode>(state.mode)) {
    case radar::Mode::rbm:
      return kRbm;
    case radar::Mode::hrm:
      return state.map_shown != 0 ? kPatch : kHrm;
    case radar::Mode::patch:
      return kPatch;
    case radar::Mode::beacon:
      return kBeacon;
    case radar::Mode::pvu:
      return kPvu;
    case radar::Mode::air_to_air:
    case radar::Mode::ranging:
      return state.map_shown != 0 ? kStandingMap : kLegendsOnly;
    case radar::Mode::menu:
      break;
  }
  return kLegendsOnly;
}

bool has_power(const databuffer::RadarState& state, radar::Power power) {
  return state.power == static_cast<std::uint8_t>(power);
}

AttitudeSource attitude_source(const databuffer::Nav& nav) {
  if ((nav.flags & databuffer::kNavAttitudeInvalid) != 0) return AttitudeSource::invalid;
  return (nav.flags & databuffer::kNavAttitudeFromAhrs) != 0 ? AttitudeSource::ahrs : AttitudeSource::ins;
}

void draw_scales(const GlassInput& input, DrawList& list) {
  const geo::Bearing antenna = geo::Bearing::degrees(input.ownship.heading_deg + input.model.antenna_azimuth_deg);
  draw_azimuth_scale((antenna - databuffer::ground_track_of(input.ownship)).degrees(), list);
  draw_elevation_scale(input.model.antenna_elevation_deg, list);
  draw_pitch_ball(input.ownship.pitch_deg, input.ownship.roll_deg, attitude_source(input.nav), list);
}

// A sector as it is seen from the aircraft.
struct Sector {
  geo::Bearing middle;
  double half_width_deg = 0.0;
};

Sector sector_of_window(const databuffer::Ownship& ownship, geo::GeoPoint centre, double window_nm) {
  const auto line = geo::geodesic_inverse({ownship.latitude_deg, ownship.longitude_deg}, centre);
  const double half_m = window_nm * geo::kMetresPerNauticalMile / 2.0;
  return {line.azimuth_at_start, std::atan2(half_m, line.distance.metres()) / geo::kRadiansPerDegree};
}

// What the antenna covers: the map that forms, else the one on the glass, else the scan.
Sector covered_sector(const GlassInput& input) {
  const databuffer::ModelStatus& model = input.model;
  if (model.map_window_nm > 0.0)
    return sector_of_window(input.ownship, {model.map_latitude_deg, model.map_longitude_deg}, model.map_window_nm);
  if (shows_map(input))
    return sector_of_window(input.ownship, {input.map.latitude_deg, input.map.longitude_deg}, input.map.window_nm);
  return {geo::Bearing::degrees(model.scan_centre_deg), model.scan_width_deg / 2.0};
}

void draw_limits(const GlassInput& input, double blind_zone_deg, DrawList& list) {
  const Sector sector = covered_sector(input);
  const double middle_deg = (sector.middle - databuffer::ground_track_of(input.ownship)).degrees();
  draw_limit_balls(middle_deg - sector.half_width_deg, middle_deg + sector.half_width_deg, blind_zone_deg, list);
}

void draw_readouts(const GlassInput& input, const Format& format, DrawList& list) {
  const databuffer::RadarState& state = input.state;
  draw_brightness(state, list);
  draw_range(state, list);
  if (format.window_size) draw_window_size(state, list);
  if (format.mapping)
    if (const auto seconds = databuffer::map_timer_s(state, input.model)) draw_map_timer(*seconds, list);
  if (format.ground) {
    draw_cursor_readout(state, list);
    draw_update_errors(state, list);
    draw_velocity_differences(state, list);
  }
  if ((state.flags & databuffer::kFreeze) != 0) draw_freeze(list);
}

// Symbols before labels, which keep clear of them.
void draw_ground(const GlassInput& input, std::span<const radar::RoutePoint> route, const GlassView& view,
                 const GlassFrame& frame, LabelMemory& labels, DrawList& list) {
  const PlacedPoints placed = place_points(input, view, frame, labels, list);
  draw_points(input.state, route, placed, list);
  const auto heading = draw_steering_line(input, view, frame, list);
  LabelQueue queue;
  add_names(input.state, placed, NameRank::selected, queue);
  add_names(input.state, placed, NameRank::target, queue);
  if (heading) queue.add(*heading);
  add_names(input.state, placed, NameRank::other, queue);
  place_labels(queue.labels(), labels, list);
}

void draw_format(const GlassInput& input, const Format& format, const radar::RadarConfiguration& configuration,
                 const GlassView& view, const GlassFrame& frame, LabelMemory& labels, DrawList& list) {
  // On a map that could not be read nobody knows where anything lies.
  const bool placed = format.ground && (!format.map || shows_map(input));
  // Before the readouts, which give way to it.
  if (placed) draw_cursor(input, view, frame, list);
  if (format.arcs) {
    const databuffer::RadarState& state = input.state;
    draw_range_arcs(view, arc_spacing(state.range_nm, state.range_index, configuration.view.arc_spacing_nm), list);
  }
  if (format.zero_line) draw_zero_azimuth_line(view, list);
  if (format.scales) draw_scales(input, list);
  if (format.limit_balls) draw_limits(input, configuration.high_resolution.blind_zone_deg, list);
  if (format.gray_scale) draw_gray_scale(list);
  if (format.readouts) draw_readouts(input, format, list);
  if (format.velocity) draw_velocity_format(input, list);
  if (placed && format.mapping) draw_window_outline(input, view, frame, list);
  if (placed) draw_ground(input, configuration.route, view, frame, labels, list);
  list.blank_behind_texts();
}

}  // namespace

bool shows_video(const databuffer::RadarState& state) {
  return has_power(state, radar::Power::operate) && format_of(state).video;
}

bool shows_map(const GlassInput& input) {
  const databuffer::RadarState& state = input.state;
  return has_power(state, radar::Power::operate) && format_of(state).map && input.map.id != 0 &&
         input.map.id == state.map_shown;
}

void draw_symbology(const GlassInput& input, const radar::RadarConfiguration& configuration, const GlassView& view,
                    const GlassFrame& frame, LabelMemory& labels, DrawList& list) {
  const databuffer::RadarState& state = input.state;
  list.clear();
  if (has_power(state, radar::Power::off)) {
    // A radar that is off is dark; but a set whose state machine is gone would be dark as well.
    if (!input.state_machine_alive) draw_silent({.state_machine_alive = false}, list);
    return;
  }
  draw_legends(state, list);
  draw_message(state, list);
  draw_silent(input, list);
  draw_mode_name(state, list);
  if (has_power(state, radar::Power::standby)) {
    draw_banner("STBY", list);
  } else if (shows_map(input)) {
    draw_format(input, format_of(state), configuration, GlassView(input.map), frame_of(input.map), labels, list);
  } else {
    draw_format(input, format_of(state), configuration, view, frame, labels, list);
  }
}

}  // namespace yars::display
