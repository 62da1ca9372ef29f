// Symbology of the radar formats (the pictures of the modes): scales, carets, readouts, legends and ground symbols.
// Inputs: DisplayInput, view and frame (plan_view.hpp); radar configuration; label positions of the last picture.
// Outputs: a draw list.
// Units: [deg]. Azimuths count from the ground track, right positive; elevations and pitch from the horizontal, up
//   positive; roll: right wing down positive.
// Source: docs/pilots_manual.md#symbology
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/text_layout.hpp"

namespace yars::radar {
struct ViewConfiguration;
}  // namespace yars::radar

namespace yars::display {

// Scales of the radar formats. A caret or ball stops at the end of its travel if its value lies beyond this end.

// Azimuth scale with the antenna caret.
void draw_azimuth_scale(double antenna_right_of_track_deg, DrawList& list);
// Two balls on the azimuth scale at the limits of the scan or map, and two ticks at +-`blind_zone_deg`, the edges of
// the blind zone. The balls may pass the scale's ticks at +-60 deg. They stop at +-115 deg, near the display's edge.
// Limits less than 6 deg apart have their balls 6 deg apart, about the middle of the sector.
void draw_limit_balls(double left_deg, double right_deg, double blind_zone_deg, DrawList& list);
// Elevation scale with the antenna caret.
void draw_elevation_scale(double antenna_deg, DrawList& list);

// Source of pitch and roll. AHRS: attitude and heading reference system.
enum class AttitudeSource : std::uint8_t { ins, ahrs, invalid };  // ins: round ball; ahrs: square; invalid: crossed out
void draw_pitch_ball(double pitch_deg, double roll_deg, AttitudeSource source, DrawList& list);

// Spacing of the range arcs as a fraction of the range. `spacing_nm` has the configured spacing [NM] for each of the
// selectable ranges; the last value applies to further ranges. A fraction below 0.05 is doubled until it is at least
// 0.05. Without a configured spacing > 0 the fraction is 0.25.
double arc_spacing(double range_nm, std::size_t range_index, std::span<const double> spacing_nm);
// Arcs at each multiple of the spacing and at the range itself.
void draw_range_arcs(const PlanView& view, double spacing, DrawList& list);
void draw_zero_azimuth_line(const PlanView& view, DrawList& list);
void draw_gray_scale(DrawList& list);

// True with power OPR in a mode that shows sweeps.
bool shows_video(const databuffer::RadarState& state);
// True with power OPR in a mode that shows a patch map, if `input` has that map.
bool shows_map(const DisplayInput& input);

// True if the display shows a cursor, which the mouse may then move.
bool takes_cursor(const DisplayInput& input);

// Sections and values of a configuration that the symbology reads. The configuration must outlive this object.
struct SymbologyParameters {
  // Converts from a configuration with view and blind zone, such as radar::RadarConfiguration.
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.high_resolution; }
  SymbologyParameters(const Configuration& whole)
      : SymbologyParameters(whole.view, whole.high_resolution.blind_zone_deg) {}
  SymbologyParameters(const radar::ViewConfiguration& view_section, double blind_zone)
      : view(view_section), blind_zone_deg(blind_zone) {}

  const radar::ViewConfiguration& view;
  double blind_zone_deg;  // [deg] either side of the ground track
};

// Draws all symbols and texts that power and mode require. With power STBY these are the legends, the message, the name
// of A/A or A/G ranging, and the word STBY. Texts report a state machine or radar model that is not alive, and a
// missing ownship. With power OFF only a state machine that is not alive is reported, and with `input.hints` how to
// switch on. `input.help` adds the help, which covers the picture.
// `view` and `frame` apply unless a patch map is shown; its picture has the view and frame of `input.map`. `labels` has
// the label positions of the last picture, and is updated.
// Pure: the same input and labels give the same list. Repeating the call with the updated labels gives the same list.
void draw_symbology(const DisplayInput& input, const SymbologyParameters& parameters, const PlanView& view,
                    const ViewFrame& frame, LabelMemory& labels, DrawList& list);

}  // namespace yars::display
