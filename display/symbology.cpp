#include "display/symbology.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "display/markers.hpp"
#include "display/present_frame.hpp"
#include "display/readouts.hpp"
#include "display/scales.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

namespace {

// A row of the table: what the format of a mode has.
struct Format {
  bool video = false;     // made by the radar model
  bool no_video = false;  // says that it has none yet
  bool arcs = false;
  bool zero_line = false;
  bool scales = false;  // azimuth and elevation scale, carets, pitch ball
  bool gray_scale = false;
  bool ground = false;    // cursor with its readout, sequence points
  bool window = false;    // window size, map timer
  bool readouts = false;  // range, brightness
};

constexpr Format kRbm{.video = true,
                      .arcs = true,
                      .zero_line = true,
                      .scales = true,
                      .gray_scale = true,
                      .ground = true,
                      .window = true,
                      .readouts = true};
constexpr Format kHrm{.no_video = true,
                      .arcs = true,
                      .scales = true,
                      .gray_scale = true,
                      .ground = true,
                      .window = true,
                      .readouts = true};
// A patch map has a frame of its own, along the line of sight; ground symbols come with it.
constexpr Format kPatch{.no_video = true, .scales = true, .window = true, .readouts = true};
constexpr Format kBeacon{
    .no_video = true, .arcs = true, .zero_line = true, .scales = true, .ground = true, .readouts = true};
constexpr Format kPvu{.no_video = true, .scales = true, .readouts = true};
constexpr Format kLegendsOnly{};

const Format& format_of(std::uint8_t mode) {
  switch (static_cast<radar::Mode>(mode)) {
    case radar::Mode::rbm:
      return kRbm;
    case radar::Mode::hrm:
      return kHrm;
    case radar::Mode::patch:
      return kPatch;
    case radar::Mode::beacon:
      return kBeacon;
    case radar::Mode::pvu:
      return kPvu;
    case radar::Mode::air_to_air:
    case radar::Mode::ranging:
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
  draw_azimuth_scale((antenna - ground_track_of(input.ownship)).degrees(), list);
  draw_elevation_scale(input.model.antenna_elevation_deg, list);
  draw_pitch_ball(input.ownship.pitch_deg, input.ownship.roll_deg, attitude_source(input.nav), list);
}

void draw_readouts(const GlassInput& input, const Format& format, DrawList& list) {
  const databuffer::RadarState& state = input.state;
  draw_brightness(state, list);
  draw_range(state, list);
  if (format.window) {
    draw_window_size(state, list);
    draw_map_timer(input.model.map_timer_s, list);
  }
  if (format.ground) draw_cursor_readout(state, list);
  if ((state.flags & databuffer::kFreeze) != 0) draw_freeze(list);
}

void draw_format(const GlassInput& input, const Format& format, const radar::RadarConfiguration& configuration,
                 const GlassView& view, const GlassFrame& frame, DrawList& list) {
  if (format.arcs) draw_range_arcs(view, list);
  if (format.zero_line) draw_zero_azimuth_line(view, list);
  if (format.scales) draw_scales(input, list);
  if (format.gray_scale) draw_gray_scale(list);
  if (format.readouts) draw_readouts(input, format, list);
  if (format.no_video) draw_banner("NO VIDEO", list);
  if (format.ground) {
    draw_cursor(input, view, frame, list);
    draw_points(input, configuration.route, view, frame, list);
  }
}

}  // namespace

bool shows_video(const databuffer::RadarState& state) {
  return has_power(state, radar::Power::operate) && format_of(state.mode).video;
}

void draw_symbology(const GlassInput& input, const radar::RadarConfiguration& configuration, const GlassView& view,
                    const GlassFrame& frame, DrawList& list) {
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
  if (has_power(state, radar::Power::standby)) {
    draw_banner("STBY", list);
  } else {
    draw_format(input, format_of(state.mode), configuration, view, frame, list);
  }
}

}  // namespace yars::display
