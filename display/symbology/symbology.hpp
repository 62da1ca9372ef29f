// Everything that is drawn over the video, by power and mode, on the fixed scales of the radar formats.
#pragma once

#include <cstddef>
#include <span>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/label_layout.hpp"
#include "display/symbology/plan_view.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display {

// The fixed scales of every radar format and what moves along them: azimuth scale with antenna caret, elevation
// scale with antenna caret and pitch ball, azimuth limit balls, range arcs, zero azimuth line, gray scale.
// Azimuths are against the ground track, elevations and pitch against the horizon; what runs off a scale stays at
// the end of its track.
void draw_azimuth_scale(double antenna_right_of_track_deg, DrawList& list);
// Two balls on the azimuth scale where the scan, or the map, begins and ends; with marks at the ends of the blind zone
// to judge them by. They pass +-60 deg and stop at the edge of the glass.
void draw_limit_balls(double left_deg, double right_deg, double blind_zone_deg, DrawList& list);
void draw_elevation_scale(double antenna_deg, DrawList& list);

enum class AttitudeSource : std::uint8_t { ins, ahrs, invalid };  // round, square, crossed out
void draw_pitch_ball(double pitch_deg, double roll_deg, AttitudeSource source, DrawList& list);

// From arc to arc as a share of the range, at least 0.05: the configuration's [NM] for this range, else a quarter.
double arc_spacing(double range_nm, std::size_t range_index, std::span<const double> spacing_nm);
// At each multiple of the spacing, and at the range itself.
void draw_range_arcs(const PlanView& view, double spacing, DrawList& list);
void draw_zero_azimuth_line(const PlanView& view, DrawList& list);
void draw_gray_scale(DrawList& list);

// Everything that is drawn over the video, by power and mode: the table of docs/spec/pilots_interface.md#symbology.
// OFF draws nothing; STBY legends and STBY; a mode without video its legends and its symbols. A patch map has
// the format of the patch, whichever mode shows it, and a view and a frame of its own. What has gone silent is named,
// whatever the power, but for a radar that is off.
// Pure: the same input and memory give the same list; with the memory that it leaves, again.

// True when the radar operates and sweeps are what the mode shows.
bool shows_video(const databuffer::RadarState& state);
// True when the radar operates and the map of the input is on the glass.
bool shows_map(const DisplayInput& input);

// `view` and `frame` are those of sweeps; on a map they are not used. `labels` is what the picture before left.
void draw_symbology(const DisplayInput& input, const radar::RadarConfiguration& configuration, const PlanView& view,
                    const ViewFrame& frame, LabelMemory& labels, DrawList& list);

}  // namespace yars::display
