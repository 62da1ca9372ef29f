// The HRM PPI: a Doppler beam sharpened sector. FULL takes 18 s, other widths in proportion; it looks ahead of and
// beside the cursor, resolves the range over 480 cells, and in azimuth as fine as the squint allows; nothing returns
// about the ground track. Source: docs/spec/pilots_interface.md#rule-2, #rule-3; docs/spec/physics.md#hrm-resolution.
#pragma once

#include "databuffer/records/model_records.hpp"
#include "lib/radar/configuration.hpp"
#include "model/antenna/antenna.hpp"
#include "model/kernel/pose.hpp"

namespace yars::model::kernel {

// What the algorithm of the beam map works with when the beam is sharpened.
radar::RadarConfiguration sharpened_configuration(const radar::RadarConfiguration& configuration);

// Ticks that one sweep of the sector gathers; at least 1.
int ticks_a_sharpened_sweep(const radar::RadarConfiguration& configuration);

// FULL about the ground track; HALF and QTR centred on the cursor, as far as they stay within FULL.
antenna::Sector sharpened_sector(const databuffer::RadarCommand& command, const Pose& pose,
                                 const radar::RadarConfiguration& configuration);

// The resolution cell that a wedge lies in: what is seen there is one. Cells are counted from the ground track; where
// they are narrower than wedges the wedge is the cell.
struct SharpenedCell {
  geo::Bearing middle;
  geo::Angle width;
};
SharpenedCell sharpened_cell(geo::Bearing left, geo::Bearing right, const Pose& pose,
                             const radar::RadarConfiguration& configuration);

// Where the dish points in HRM: down to the cursor, or to the map.
geo::Angle elevation_to(const Pose& pose, geo::GeoPoint target, double ground_m);

}  // namespace yars::model::kernel
