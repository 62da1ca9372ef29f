// Limits of mapping: ranges, windows, formation time, and where a patch map can be made.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::radar {

// Which range the radar takes by itself: low over ground a short one, high up a long one.
// Source: docs/spec/pilots_interface.md#rule-1, by the table of the configuration (a height belongs to the lower
// range).

// The range for a height over ground or sea. A NaN height counts as high.
geo::Length range_by_height(geo::Length height, const HeightRanges& table);

// Index of the shortest range [NM] that is not below the wanted one; of the last where all are shorter.
// `ranges_nm` ascends and is not empty.
std::size_t range_index_for(geo::Length wanted, std::span<const double> ranges_nm);

// Display windows of patch maps: which fit the selected range, where the cursor may be for each, and which one a
// blank window stands for. Source: docs/spec/pilots_interface.md#rule-4 (tables 1 to 3 of the report), by the tables of
// the configuration.

// Least and greatest cursor range at which a window can be mapped; both ends belong to it.
struct CursorLimits {
  geo::Length least;
  geo::Length greatest;
  bool contains(geo::Length range) const { return least <= range && range <= greatest; }
};

// Limits of a window; nothing for a size that the table does not name.
std::optional<CursorLimits> cursor_limits(geo::Length window, const WindowLimits& table);

// Index of the largest window [NM] that is not larger than the range; nothing when all are. `windows_nm` ascends.
std::optional<std::size_t> largest_window_that_fits(geo::Length range, std::span<const double> windows_nm);

// The window that a map takes while the selection is blank, by the cursor's range; nothing: the command is rejected.
std::optional<geo::Length> window_while_blank(geo::Length cursor_range, const WindowLimits& table);

// How long the radar takes to form a map, and what it resolves. Azimuth resolution of a synthetic array of length L:
// rho = k lambda R / (2 L sin(squint)); it is held, so the time T = k lambda R / (2 V rho sin(squint)) follows, once a
// look and once a strip where the window is wider than the beam.
// Source: docs/spec/physics.md#formation-time; Carrara, Goodman, Majewski, "Spotlight Synthetic Aperture Radar", 2.3.
// Check: 480 kt, 9.6 GHz, 8.5 ft, 20 NM, 90 degrees: 1.1 s.
inline constexpr int kCellsOfMap = 480;  // resolution cells along an edge of a window, whatever the window

// Side of a resolution cell: the window over kCellsOfMap.
geo::Length map_resolution(geo::Length window);

// Strips of one beam width [from the aircraft] that cover the window; at least 1.
int map_strips(geo::Length window, geo::Length slant_range, geo::Angle azimuth_beamwidth);

struct MapLook {
  geo::Length slant_range;
  geo::Length window;
  geo::Angle squint;  // line of sight against the ground track
  geo::Speed ground_speed;
  int looks = 1;
};

// Never longer than the cap of the configuration: at small squints and speeds, where the formula goes to infinity.
geo::Duration formation_time(const MapLook& look, const RadarConfiguration& configuration);

// True if the line of sight lies so near the ground track that there is too little Doppler to map
// (docs/spec/pilots_interface.md#rule-3).
bool in_blind_zone(geo::Angle squint, const HighResolutionConfiguration& configuration);

// Angle that the Doppler beam sharpened scan resolves: lambda / (2 V T sin(squint)), at most the beam's own width.
geo::Angle dbs_beamwidth(geo::Angle squint, geo::Speed ground_speed, const RadarConfiguration& configuration);

// Whether the radar can make a patch map of a place, and if not, what the display says. Holds for a first map and for
// every re-map. Source: docs/spec/pilots_interface.md#rule-2, #rule-3, #rule-4, #rule-5; tables 3 and 4 of the report.

// Where the aircraft is and flies; bearings true.
struct MapViewpoint {
  geo::GeoPoint aircraft;
  geo::Bearing heading;
  geo::Bearing ground_track;
};

struct MapWindow {
  geo::Length size;    // zero: by the range, while the selection is blank
  bool blank = false;  // no window was selected: a size is held by the blank selection's limits, too
};

// Nothing: mappable. Either point may not be finite: then "NO CURSOR".
std::optional<std::string_view> why_not_mappable(const MapViewpoint& from, geo::GeoPoint place, const MapWindow& window,
                                                 const RadarConfiguration& configuration);

}  // namespace yars::radar
