#include "display/symbology/symbology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "databuffer/messages/derived_values.hpp"
#include "display/symbology/ground_symbols.hpp"
#include "display/symbology/overlay_texts.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/radar_video.hpp"
#include "display/symbology/readouts.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/view.hpp"

namespace yars::display {

namespace {

// Azimuth scale, along the bottom at the height of the apex. The window size is below this scale, messages are above.
// Positions [units].
constexpr float kAzimuthZero = 240.0F;  // [units] x of 0 deg
constexpr float kAzimuthUnitsPerDegree = 2.0F;
constexpr float kAzimuthTickTop = 438.0F, kAzimuthTickBottom = 445.0F;
constexpr float kCaretLimit = 64.0F;  // [deg] azimuth at which the caret stops
constexpr float kLimitBallRadius = 3.0F;
constexpr float kBallLimit = 115.0F;  // [deg] azimuth at which a limit ball stops: x = 10 or 470 units
// [deg] Least spacing of the limit balls, 12 units. Nearer balls would merge with each other and hide the caret's tip.
constexpr float kMinBallSpacing = 6.0F;
constexpr float kCaretGap = 3.0F;  // [units] from the caret's tip to the ticks; the balls rise above the ticks' middle

// Elevation scale, in the column between the legends of the left side and the picture. Positions [units].
constexpr float kElevationZero = 240.0F;  // [units] y of the horizon
constexpr float kElevationUnitsPerDegree = 8.0F;
constexpr float kElevationTickLeft = 68.0F;
constexpr float kElevationTop = 46.0F, kElevationBottom = 434.0F;  // [units] y at which caret and pitch ball stop
constexpr float kBallColumn = 92.0F;                               // [units] x of the pitch ball's centre
constexpr float kBallRadius = 5.5F;
constexpr float kWing = 5.0F;                            // [units] length of each wing of the pitch ball
constexpr float kCaretLength = 8.0F, kCaretHalf = 4.0F;  // length and half width of both carets

// Gray scale, in the lower right, outside the +-60 deg sector. [units]
constexpr Rect kGrayScale{420.0F, 344.0F, 434.0F, 424.0F};

constexpr float kArcHalfSector = 60.0F;      // [deg] the arcs end this far from the ground track on either side
constexpr double kDefaultArcSpacing = 0.25;  // fraction of the range
constexpr double kMinArcSpacing = 0.05;      // fraction of the range; closer arcs would hide the video

float elevation_y(double degrees) {
  const float y = kElevationZero - kElevationUnitsPerDegree * static_cast<float>(degrees);
  return std::clamp(y, kElevationTop, kElevationBottom);
}

float x_of(float degrees) {
  return kAzimuthZero + kAzimuthUnitsPerDegree * degrees;
}

float tick_length(int degrees) {
  return degrees == 0 ? 12.0F : std::abs(degrees) >= 5 ? 8.0F : 5.0F;
}

}  // namespace

void draw_azimuth_scale(double antenna_right_of_track_deg, DrawList& list) {
  for (const float degrees : {-60.0F, 0.0F, 60.0F}) {
    list.line({x_of(degrees), kAzimuthTickTop}, {x_of(degrees), kAzimuthTickBottom});
  }
  const float x = x_of(std::clamp(static_cast<float>(antenna_right_of_track_deg), -kCaretLimit, kCaretLimit));
  const float tip = kAzimuthTickTop - kCaretGap;
  const std::array<Point, 3> caret{Point{x - kCaretHalf, tip - kCaretLength}, Point{x, tip},
                                   Point{x + kCaretHalf, tip - kCaretLength}};
  list.polyline(caret);
  list.occupy("azimuth scale",
              {x_of(-kCaretLimit) - kCaretHalf, tip - kCaretLength - 1.0F, x_of(kCaretLimit) + kCaretHalf,
               kAzimuthTickBottom + 1.0F},
              BoxKind::scale);
  list.occupy("azimuth ticks", {x_of(-60.0F) - 2.0F, kAzimuthTickTop - 1.0F, x_of(60.0F) + 2.0F, kAzimuthTickBottom},
              BoxKind::solid);
}

void draw_limit_balls(double left_deg, double right_deg, double blind_zone_deg, DrawList& list) {
  constexpr float middle = (kAzimuthTickTop + kAzimuthTickBottom) / 2.0F;
  const auto blind = static_cast<float>(blind_zone_deg);
  for (const float degrees : {-blind, blind}) list.line({x_of(degrees), middle}, {x_of(degrees), kAzimuthTickBottom});
  float left = std::clamp(static_cast<float>(left_deg), -kBallLimit, kBallLimit);
  float right = std::clamp(static_cast<float>(right_deg), -kBallLimit, kBallLimit);
  if (right - left < kMinBallSpacing) {
    const float centre =
        std::clamp((left + right) / 2.0F, kMinBallSpacing / 2.0F - kBallLimit, kBallLimit - kMinBallSpacing / 2.0F);
    left = centre - kMinBallSpacing / 2.0F;
    right = centre + kMinBallSpacing / 2.0F;
  }
  for (const float degrees : {left, right}) {
    const float x = x_of(degrees);
    list.circle({x, middle}, kLimitBallRadius);
    list.occupy("limit ball", grown({x, middle, x, middle}, kLimitBallRadius + 1.0F), BoxKind::scale);
  }
}

void draw_elevation_scale(double antenna_deg, DrawList& list) {
  for (const int degrees : {-10, -5, -2, -1, 0, 1, 2, 5, 10}) {
    const float y = elevation_y(degrees);
    list.line({kElevationTickLeft, y}, {kElevationTickLeft + tick_length(degrees), y});
  }
  const float y = elevation_y(antenna_deg);
  const float tip = kElevationTickLeft - 1.0F;
  const std::array<Point, 3> caret{Point{tip - kCaretLength, y - kCaretHalf}, Point{tip, y},
                                   Point{tip - kCaretLength, y + kCaretHalf}};
  list.polyline(caret);
  list.occupy("elevation scale",
              {tip - kCaretLength, kElevationTop - kBallRadius - kWing, kBallColumn + kBallRadius + kWing,
               kElevationBottom + kBallRadius},
              BoxKind::scale);
}

void draw_pitch_ball(double pitch_deg, double roll_deg, AttitudeSource source, DrawList& list) {
  const Point center{kBallColumn, elevation_y(pitch_deg)};
  const float r = kBallRadius;
  if (source == AttitudeSource::ahrs) {
    const std::array<Point, 4> corners{Point{center.x - r, center.y - r}, Point{center.x + r, center.y - r},
                                       Point{center.x + r, center.y + r}, Point{center.x - r, center.y + r}};
    list.polygon(corners, false);
  } else {
    list.circle(center, r);
  }
  if (source == AttitudeSource::invalid) {
    const float d = r + 2.0F;
    list.line({center.x - d, center.y - d}, {center.x + d, center.y + d});
    list.line({center.x - d, center.y + d}, {center.x + d, center.y - d});
    return;
  }
  // Wings show the bank. If the right wing of the aircraft is down, the right wing of the symbol is down.
  const auto cosine = static_cast<float>(std::cos(roll_deg * geo::kRadiansPerDegree));
  const auto sine = static_cast<float>(std::sin(roll_deg * geo::kRadiansPerDegree));
  for (const float side : {-1.0F, 1.0F}) {
    const auto out = [&](float length) {
      return Point{center.x + side * length * cosine, center.y + side * length * sine};
    };
    list.line(out(r), out(r + kWing));
  }
}

double arc_spacing(double range_nm, std::size_t range_index, std::span<const double> spacing_nm) {
  if (spacing_nm.empty()) return kDefaultArcSpacing;
  double spacing = spacing_nm[std::min(range_index, spacing_nm.size() - 1)] / range_nm;
  if (!(spacing > 0.0)) return kDefaultArcSpacing;
  while (spacing < kMinArcSpacing) spacing *= 2.0;
  return spacing;
}

void draw_range_arcs(const PlanView& view, double spacing, DrawList& list) {
  constexpr double kRounding = 1e-9;  // tolerance; without it the arc at full range could be drawn twice
  list.draw_on(Layer::grid);
  const auto arc = [&](double fraction) {
    list.thin_arc(view.apex(), static_cast<float>(fraction) * view.units_per_range(), -kArcHalfSector, kArcHalfSector);
  };
  for (int i = 1; i * spacing < 1.0 - kRounding; ++i) arc(i * spacing);
  arc(1.0);
  list.draw_on(Layer::symbols);
}

void draw_zero_azimuth_line(const PlanView& view, DrawList& list) {
  list.draw_on(Layer::grid);
  list.line(view.apex(), view.at_polar(0.0, 1.0), Ink::dim);
  list.draw_on(Layer::symbols);
}

void draw_gray_scale(DrawList& list) {
  const float height = (kGrayScale.bottom - kGrayScale.top) / kGrays;
  for (int gray = 0; gray < kGrays; ++gray) {
    // Video level in the middle of the levels of each gray. The darkest gray is at the bottom.
    const auto video = static_cast<std::uint8_t>((gray * 256 + 128) / kGrays);
    const float bottom = kGrayScale.bottom - height * static_cast<float>(gray);
    list.video_step({kGrayScale.left, bottom - height, kGrayScale.right, bottom}, video);
  }
  const std::array<Point, 5> frame{Point{kGrayScale.left, kGrayScale.top}, Point{kGrayScale.right, kGrayScale.top},
                                   Point{kGrayScale.right, kGrayScale.bottom},
                                   Point{kGrayScale.left, kGrayScale.bottom}, Point{kGrayScale.left, kGrayScale.top}};
  list.polyline(frame, Ink::dim);
  list.occupy("gray scale", kGrayScale, BoxKind::solid);
}

namespace {

// Elements that the display shows in a mode. Source: column "in" of the table docs/pilots_manual.md#symbology.
struct Format {
  bool video = false;  // sweeps
  bool map = false;    // a patch map
  bool arcs = false;
  bool zero_line = false;
  bool scales = false;       // azimuth and elevation scale, carets, pitch ball
  bool limit_balls = false;  // limits of the scan or the map on the azimuth scale
  bool gray_scale = false;
  bool ground = false;  // cursor with readout, sequence points, steering line, UPDT errors, IPVU differences
  bool window_size = false;
  bool mapping = false;   // window outline and map timer
  bool readouts = false;  // range, brightness, FREEZE
  bool velocity = false;  // velocity differences and current beam of PVU
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
// Format of A/A and A/G ranging with a map that HRM has left on the display. No new map forms in these modes.
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

// True if the display shows symbols at ground positions: cursor, points, steering line. The position of a map that
// could not be read is unknown; then there are none.
bool shows_ground(const DisplayInput& input) {
  const Format& format = format_of(input.state);
  return has_power(input.state, radar::Power::operate) && format.ground && (!format.map || shows_map(input));
}

void draw_scales(const DisplayInput& input, DrawList& list) {
  const geo::Bearing antenna = geo::Bearing::degrees(input.ownship.heading_deg + input.model.antenna_azimuth_deg);
  draw_azimuth_scale((antenna - databuffer::ground_track_of(input.ownship)).degrees(), list);
  draw_elevation_scale(input.model.antenna_elevation_deg, list);
  draw_pitch_ball(input.ownship.pitch_deg, input.ownship.roll_deg, attitude_source(input.nav), list);
}

// Sector in azimuth from the aircraft.
struct Sector {
  geo::Bearing middle;  // true bearing
  double half_width_deg = 0.0;
};

Sector sector_of_window(const databuffer::Ownship& ownship, geo::GeoPoint centre, double window_nm) {
  const auto line = geo::geodesic_inverse({ownship.latitude_deg, ownship.longitude_deg}, centre);
  const double half_m = window_nm * geo::kMetresPerNauticalMile / 2.0;
  return {line.azimuth_at_start, std::atan2(half_m, line.distance.metres()) / geo::kRadiansPerDegree};
}

// Sector of the map that forms, else of the map shown, else of the scan.
Sector covered_sector(const DisplayInput& input) {
  const databuffer::ModelStatus& model = input.model;
  if (model.map_window_nm > 0.0)
    return sector_of_window(input.ownship, {model.map_latitude_deg, model.map_longitude_deg}, model.map_window_nm);
  if (shows_map(input))
    return sector_of_window(input.ownship, {input.map.latitude_deg, input.map.longitude_deg}, input.map.window_nm);
  return {geo::Bearing::degrees(model.scan_centre_deg), model.scan_width_deg / 2.0};
}

void draw_limits(const DisplayInput& input, double blind_zone_deg, DrawList& list) {
  const Sector sector = covered_sector(input);
  const double middle_deg = (sector.middle - databuffer::ground_track_of(input.ownship)).degrees();
  draw_limit_balls(middle_deg - sector.half_width_deg, middle_deg + sector.half_width_deg, blind_zone_deg, list);
}

void draw_readouts(const DisplayInput& input, const Format& format, DrawList& list) {
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

// Symbols are drawn before labels, because labels are placed clear of symbols.
void draw_ground(const DisplayInput& input, const PlanView& view, const ViewFrame& frame, LabelMemory& labels,
                 DrawList& list) {
  const PlacedPoints placed = place_points(input, view, frame, labels, list);
  draw_points(input.state, placed, list);
  const auto heading = draw_steering_line(input, view, frame, list);
  LabelQueue queue;
  add_names(input.state, placed, NameRank::selected, queue);
  add_names(input.state, placed, NameRank::target, queue);
  if (heading) queue.add(*heading);
  add_names(input.state, placed, NameRank::other, queue);
  place_labels(queue.labels(), labels, list);
}

void draw_format(const DisplayInput& input, const Format& format, const SymbologyParameters& parameters,
                 const PlanView& view, const ViewFrame& frame, LabelMemory& labels, DrawList& list) {
  const bool placed = shows_ground(input);
  const databuffer::RadarState& state = input.state;
  if (format.arcs)
    draw_range_arcs(view, arc_spacing(state.range_nm, state.range_index, parameters.view.arc_spacing_nm), list);
  if (format.zero_line) draw_zero_azimuth_line(view, list);
  if (format.scales) draw_scales(input, list);
  if (format.limit_balls) draw_limits(input, parameters.blind_zone_deg, list);
  if (format.gray_scale) draw_gray_scale(list);
  if (format.readouts) draw_readouts(input, format, list);
  draw_mode_name(input, list);
  if (placed && cursor_is_off(input, view, frame)) draw_cursor_off(list);
  if (placed && format.map) draw_map_width(input.map, list);
  if (format.velocity) draw_velocity_format(input, list);
  if (placed && format.mapping) draw_window_outline(input, view, frame, list);
  if (placed) draw_ground(input, view, frame, labels, list);
  list.blank_behind_texts();
}

}  // namespace

bool shows_video(const databuffer::RadarState& state) {
  return has_power(state, radar::Power::operate) && format_of(state).video;
}

bool shows_map(const DisplayInput& input) {
  const databuffer::RadarState& state = input.state;
  return has_power(state, radar::Power::operate) && format_of(state).map && input.map.id != 0 &&
         input.map.id == state.map_shown;
}

bool takes_cursor(const DisplayInput& input) {
  const bool set_or_ground = &format_of(input.state) != &kStandingMap || (input.state.flags & databuffer::kSet) != 0;
  return shows_ground(input) && set_or_ground;
}

namespace {

// Everything that power and mode require.
void draw_radar(const DisplayInput& input, const SymbologyParameters& parameters, const PlanView& view,
                const ViewFrame& frame, LabelMemory& labels, DrawList& list) {
  const databuffer::RadarState& state = input.state;
  draw_state(input, list);
  if (has_power(state, radar::Power::off)) {
    // A session that never had a state machine has power OFF, too. Therefore a missing state machine is reported even
    // with power OFF.
    if (!input.state_machine_alive) draw_silent({.state_machine_alive = false}, list);
    return;
  }
  draw_legends(state, list);
  draw_message(input, list);
  draw_silent(input, list);
  if (has_power(state, radar::Power::standby)) return draw_mode_name(input, list);
  draw_format(input, format_of(state), parameters, view, frame, labels, list);
}

}  // namespace

void draw_symbology(const DisplayInput& input, const SymbologyParameters& parameters, const PlanView& view,
                    const ViewFrame& frame, LabelMemory& labels, DrawList& list) {
  list.clear();
  const bool map = shows_map(input);
  const PlanView shown_view = map ? PlanView(input.map) : view;
  const ViewFrame shown_frame = map ? frame_of(input.map) : frame;
  // Texts keep clear of the cursor, so its place is known first. Its arms end before texts, so it is drawn last.
  const auto cursor = shows_ground(input) ? cursor_at(input, shown_view, shown_frame) : std::nullopt;
  if (cursor) occupy_cursor(*cursor, list);
  draw_radar(input, parameters, shown_view, shown_frame, labels, list);
  draw_caption(input.caption, list);
  if (cursor) draw_cursor(*cursor, list);
  // Last, so that the texts of the help do not move the labels.
  if (input.help) draw_help(input, list);
}

}  // namespace yars::display
