// Where a patch map lies, and how a place becomes a point on it. The plane: distance and bearing from the aircraft are
// kept (azimuthal equidistant), turned so that the bearing of the centre points up; straight lines through the aircraft
// are its lines of sight. `right` and `up` are metres from the centre; `ahead` = up + the centre's distance.
// Heights count from the map plane, which is level at the centre's elevation and bends with the effective earth.
#pragma once

#include <cstdint>

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/geo/height.hpp"
#include "lib/radar/configuration.hpp"
#include "model/rbm/earth.hpp"

namespace yars::model::hrm {

// Every value finite, the window greater than 0, the centre farther from the apex than the window's half diagonal: the
// kernel sees to it.
struct PatchOrder {
  geo::GeoPoint apex;
  geo::AltitudeMsl altitude;
  geo::Bearing ground_track;
  geo::Speed ground_speed;
  geo::GeoPoint centre;
  geo::Length window;
  int looks = 2;
  geo::Duration sim_time{};  // of the start
  std::uint32_t map = 0;     // number of the map: names its noise
  std::uint8_t band = 0;
  std::uint8_t channel = 1;
};

struct MapPoint {
  double right_m = 0.0;
  double up_m = 0.0;
};

class PatchGeometry {
 public:
  // `elevation_m` [m] MSL of the map plane: the ground at the centre.
  PatchGeometry(const PatchOrder& order, const radar::Fidelity& fidelity, double elevation_m);

  MapPoint point_of(geo::GeoPoint place) const;
  geo::GeoPoint place_of(MapPoint point) const;

  geo::GeoPoint apex() const { return apex_; }
  geo::Bearing up() const { return up_; }
  double distance_m() const { return distance_m_; }  // over ground, apex to centre
  double window_m() const { return window_m_; }
  double plane_msl_m() const { return plane_msl_m_; }
  double altitude_m() const { return altitude_m_; }  // of the aircraft, MSL
  const rbm::EffectiveEarth& earth() const { return earth_; }

  // How far the aircraft is above the map plane where it has bent away, at a distance over ground [m].
  double above_plane_m(double distance_m) const { return altitude_m_ - plane_msl_m_ + earth_.drop_m(distance_m); }
  // The same against the horizontal there: how much nearer a point comes when it is raised (layover).
  double above_level_m(double distance_m) const { return altitude_m_ - plane_msl_m_ - earth_.drop_m(distance_m); }
  // Height above the map plane [m] at which a line of sight passes a distance over ground. `tangent`: of its elevation,
  // as rbm::EffectiveEarth has it for heights above mean sea level.
  double height_on_sight_m(double distance_m, double tangent) const;
  double slant_range_m() const;  // aircraft to centre
  double sin_grazing() const;    // on the map plane at the centre
  geo::Angle squint(geo::Bearing ground_track) const { return up_ - ground_track; }

 private:
  geo::GeoPoint apex_;
  double altitude_m_;
  double plane_msl_m_;
  double distance_m_;
  geo::Bearing up_;
  double window_m_;
  rbm::EffectiveEarth earth_;
};

// Where a scatterer appears: distance over ground [m] of the point on the map plane that is as far from the aircraft
// (layover, foreshortening). `above_level_m`: as the geometry has it; `height_m`: the scatterer above the plane.
// d'^2 = d^2 + height (height - 2 above); 0 where nothing on the plane is as near. Height over earth radius of the
// layover is left out: 0.1 % at 9 km.
double laid_over_m(double distance_m, double height_m, double above_level_m);

}  // namespace yars::model::hrm
