// How long the radar takes to form a map, and what it resolves. Azimuth resolution of a synthetic array of length L:
// rho = k lambda R / (2 L sin(squint)); it is held, so the time T = k lambda R / (2 V rho sin(squint)) follows, once a
// look and once a strip where the window is wider than the beam.
// Source: docs/spec/physics.md#formation-time; Carrara, Goodman, Majewski, "Spotlight Synthetic Aperture Radar", 2.3.
// Check: 480 kt, 9.6 GHz, 8.5 ft, 20 NM, 90 degrees: 1.1 s.
#pragma once

#include "lib/geo/bearing.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::radar {

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
geo::Angle sharpened_beamwidth(geo::Angle squint, geo::Speed ground_speed, const RadarConfiguration& configuration);

}  // namespace yars::radar
