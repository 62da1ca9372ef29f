// Pictures of the radar state. Patch maps: command, completion, cancellation, freeze, recall and storage. Projection of
// the present picture, between the ground and the display. Inputs: cursor, ownship, model status, records of maps;
// frame (apex and up direction) of the picture, selected range, limits of the display.
// Outputs: map command; ids of NEW (newest map), OLD (last map of an earlier command, or a map that was stored), STORE
// (stored by the pilot) and the map shown; messages. Positions on the display, in multiples of PicturePlane::unit;
// ground positions (WGS84).
// Errors: no projection of a map without a record. Source: docs/pilots_manual.md#view.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/view.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Freeze, recall of maps on the frozen picture, and SET.
// Source: docs/pilots_manual.md#rule-8, #rule-9, #rule-10, #rule-19, #rule-20, #rule-21.
void toggle_freeze(Step& step);
void flip_recall(Step& step);   // PB 10: toggles NEW and OLD, or with a stored map NEW and STORE
void toggle_store(Step& step);  // PB 15: stores the map shown, which PB 10 then shows instead of OLD; or releases it
void toggle_set(Step& step);    // PB 18: switches whether the cursor functions apply to the frozen map

void freeze(databuffer::RadarState& state);
void thaw(databuffer::RadarState& state);  // ends the freeze and recall, and clears the stored map

// Rule 19: freezes HRM while SNIFF is on.
void freeze_silent_hrm(databuffer::RadarState& state);

// Rule 21: leaving HRM for another master mode freezes the map shown, or on a PPI the newest map. The return to A/G
// ends that freeze unless SET is on. Source: the 1996 report, appendix A, "Set Function": "the last HRM map is
// automatically frozen".
void freeze_on_leaving(databuffer::RadarState& state);
void thaw_on_return(databuffer::RadarState& state);

// Id of the map that the display must show; 0 = none.
std::uint64_t map_to_show(const databuffer::RadarState& state);

// Command, completion and cancellation of maps.
// Source: docs/pilots_manual.md#rule-3, #rule-4, #rule-5, #rule-6, #rule-7, #rule-8.

// TDC release with cursor MAP: commands a map at the cursor. Refused with the reason if a radar limit forbids the map,
// or if no window fits the blank selection.
void command_map(Step& step);

// Cancels the commanded map: a new request number makes the model's result obsolete. Position and window in the state
// become those of the newest map, because in patch mode the radar model repeats the map at this position.
void cancel_map(databuffer::RadarState& state, const Inputs& inputs);

// Takes a completed map of the model. The commanded map becomes NEW; the stored map, or without one the former NEW,
// becomes OLD. take_map then returns true, and the caller enters patch mode. A re-map of the patch replaces NEW. Any
// other map is ignored. If the model could not make the commanded map, cancels the command and shows the reason.
bool take_map(databuffer::RadarState& state, const Inputs& inputs);

// While the radar model cannot re-map the patch, shows the model's reason as a message.
void show_remap_stop(databuffer::RadarState& state, const Inputs& inputs);

// Record of the map with this id; nullptr if there is none.
const databuffer::PatchMap* map_of(const Inputs& inputs, std::uint64_t id);

// Position on the display: x right, y up. PicturePlane defines the origin and the unit.
struct DisplayPoint {
  double x = 0.0;
  double y = 0.0;
};

// Projection of the display: geodesic distance and azimuth from an apex, plotted on a plane (azimuthal equidistant).
struct PicturePlane {
  geo::GeoPoint apex;  // below the aircraft: now; for a frozen picture or a map, when it was frozen or begun
  geo::Bearing up;     // direction at the apex that is upward on the display
  geo::Length unit;    // ground distance of 1 on the display: the selected range, or the window of the map
  geo::Length ahead;   // distance of the origin from the apex, upward
  // Limits of the display, in multiples of `unit`.
  radar::ViewConfiguration view;

  DisplayPoint display_from_ground(geo::GeoPoint position) const {
    const geo::PlanePoint point = geo::AzimuthalEquidistant(apex, up).plane_from_geodetic(position);
    return {geo::Length::metres(point.x_m) / unit, (geo::Length::metres(point.y_m) - ahead) / unit};
  }
  geo::GeoPoint ground_from_display(DisplayPoint point) const {
    return geo::AzimuthalEquidistant(apex, up).geodetic_from_plane(
        {(point.x * unit).metres(), (point.y * unit + ahead).metres()});
  }
  bool shows(DisplayPoint point) const {
    return point.x >= view.width_min && point.x <= view.width_max && point.y >= view.height_min &&
           point.y <= view.height_max;
  }
  // Position at fractions [0, 1] of the square display, from its upper left corner, limited to the visible area.
  DisplayPoint at_fractions(double right, double down) const;
  // Distance between two positions on the display, in display units. A display unit is 1/480 of the display's longer
  // edge. It is not PicturePlane::unit.
  double units_between(DisplayPoint a, DisplayPoint b) const;
  double edge() const;  // length of the display's edge, in multiples of `unit`
};

// Projection of the present picture. nullopt: the shown map has no record, so its position is unknown.
std::optional<PicturePlane> plane_of(const databuffer::RadarState& state, const Inputs& inputs,
                                     const radar::ViewConfiguration& view);

}  // namespace yars::statemachine
