// The fixed scales of every radar format and what moves along them: azimuth scale with antenna caret, elevation
// scale with antenna caret and pitch ball, azimuth limit balls, range arcs, zero azimuth line, gray scale.
// Azimuths are against the ground track, elevations and pitch against the horizon; what runs off a scale stays at
// the end of its track.
#pragma once

#include <span>

#include "display/draw_list.hpp"
#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"

namespace yars::display {

void draw_azimuth_scale(double antenna_right_of_track_deg, DrawList& list);
// Two balls on the azimuth scale where the scan, or the map, begins and ends; with marks at the ends of the blind zone
// to judge them by. They pass +-60 deg and stop at the edge of the glass.
void draw_limit_balls(double left_deg, double right_deg, double blind_zone_deg, DrawList& list);
void draw_elevation_scale(double antenna_deg, DrawList& list);

enum class AttitudeSource : std::uint8_t { ins, ahrs, invalid };  // round, square, crossed out
void draw_pitch_ball(double pitch_deg, double roll_deg, AttitudeSource source, DrawList& list);

// At `rings_nm` as far as they lie within the frame's range; without any at its quarters.
void draw_range_arcs(const GlassView& view, std::span<const double> rings_nm, double range_m, DrawList& list);
void draw_zero_azimuth_line(const GlassView& view, DrawList& list);
void draw_gray_scale(DrawList& list);

}  // namespace yars::display
