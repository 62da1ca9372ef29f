// What a configuration settles about the world that the radar looks at: what surfaces return, the sea's state, rain,
// jammers, moving targets, polygonal scenes, beacons. Pure values; defaults are those of GUF.
// Source: docs/spec/physics.md#power-and-video.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"

namespace yars::radar {

inline constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

// Surface material codes are those of DFAD; 0 stands for a place without culture.
inline constexpr int kMaterials = 32;     // codes 0..31
inline constexpr int kWaterMaterial = 6;  // returns what the sea returns
inline constexpr int kMaxRainCells = 64;  // bounds on what one sweep has to look at
inline constexpr int kMaxJammers = 16;
inline constexpr int kMaxMovers = 64;
inline constexpr int kMaxBeacons = 64;
inline constexpr int kMaxReplies = 6;
inline constexpr int kMaxScenes = 1024;

// What a surface material returns: sigma0 = gamma sin(grazing).
struct Material {
  int code = 0;  // 1..31 but for water
  std::string name;
  double gamma_db = 0.0;     // [dB] at the land's reference frequency
  double cardinal_db = 0.0;  // [dB] more where its walls face the radar
  double texture = 0.0;      // shape of the gamma texture, small = spiky; 0 = none
};

// Land without culture returns Receiver.landGamma.
struct LandConfiguration {
  double frequency_slope_db = 5.0;        // [dB] a decade of frequency
  double reference_frequency_ghz = 10.0;  // [GHz] where the gammas hold
  double street_width_deg = 6.0;          // [deg] between half powers: how closely walls have to face the radar
  double texture = 0.0;                   // of land without culture
  std::vector<Material> materials{
      {1, "metal", 5.0, 12.0, 1.5},         {2, "part metal", 2.0, 10.0, 2.0},
      {3, "stone", 0.0, 10.0, 3.0},         {4, "composition", -3.0, 8.0, 4.0},
      {5, "earthen works", -8.0, 0.0, 0.0}, {7, "sand", -22.0, 0.0, 0.0},
      {8, "rock", -8.0, 0.0, 0.0},          {9, "asphalt and concrete", -28.0, 0.0, 0.0},
      {10, "soil", -17.0, 0.0, 0.0},        {11, "marsh", -16.0, 0.0, 0.0},
      {12, "trees", -12.0, 0.0, 8.0},       {13, "snow and ice", -20.0, 0.0, 0.0}};  // ascending codes
};

enum class Polarization : std::uint8_t { horizontal = 0, vertical = 1 };

// Coefficients c1..c5 of the sea's return: Gregers-Hansen and Mital, NRL 2012 (DTIC ADA559494), table 2.
struct SeaConfiguration {
  double state = kNotGiven;  // 0..6, WMO code 3700; not given: by the wind
  double wind_speed_mps = geo::Speed::knots(10.0).metres_per_second();
  double wind_from_deg = 270.0;  // [deg] true
  Polarization polarization = Polarization::horizontal;
  std::vector<double> horizontal{-73.0, 20.781, 7.351, 25.65, 0.0054};
  std::vector<double> vertical{-50.796, 25.93, 0.7093, 21.588, 0.00211};
  double wind_factor = 0.2;  // of the GIT model's upwind term; 0 = the same from every side
  double texture = 4.0;      // shape of the gamma texture; 0 = none
};

// A shower: a vertical cylinder, heaviest in the middle, nothing at the rim and above the top.
struct RainCell {
  geo::GeoPoint place;
  double radius_m = 9260.0;  // 5 NM
  double rate_mmh = 10.0;    // [mm/h] in the middle
  double top_m = 4572.0;     // [m] MSL; 15,000 ft
};

struct RainConfiguration {
  double reflectivity_factor = 200.0;   // a of Z = a r^b [mm^6/m^3, mm/h]; Marshall and Palmer 1948
  double reflectivity_exponent = 1.6;   // b
  double dielectric_factor = 0.93;      // |K|^2 of water
  double attenuation_factor = 0.01018;  // k of k r^b [dB/km one way]; ITU-R P.838-3 at 9.6 GHz, horizontal
  double attenuation_exponent = 1.278;
  std::vector<RainCell> cells;
};

inline constexpr int kEveryBand = -1;

struct Jammer {
  std::string name;
  geo::GeoPoint place;
  double altitude_m = kNotGiven;                         // [m] MSL; not given: a mast on the ground
  int band = kEveryBand;                                 // 0..4: A..E
  std::vector<double> channels{1, 2, 3, 4, 5, 6, 7, 8};  // ascending
  double power_w = 10.0;                                 // [W] effective radiated, within the receiver's bandwidth
};

struct JammingConfiguration {
  double radar_power_dbw = 72.0;  // [dBW] the radar's own effective radiated peak power: the scale of the others
  double sidelobe_db = -35.0;     // [dB] least gain of the antenna one way, against its beam's centre
  std::vector<Jammer> jammers;
};

// A radar beacon on the ground: it answers a pulse of its code by a train of pulses.
struct Beacon {
  std::string name;
  geo::GeoPoint place;
  double altitude_m = kNotGiven;  // [m] MSL; not given: a mast on the ground
  int code = 1;                   // that it answers to
  double delay_us = 2.0;          // [us] from the pulse that it hears to the first reply
  int replies = 2;                // 2..kMaxReplies
  double spacing_us = 10.0;       // [us] between replies: by it the pilot knows whom he sees
  double power_w = 100.0;         // [W] effective radiated
};

struct BeaconConfiguration {
  int code = 1;  // that the radar asks for
  std::vector<Beacon> beacons;
};

// A ship or a vehicle: a point that goes its great circle at a steady speed from sim time 0 on.
struct Mover {
  std::string name;
  geo::GeoPoint place;  // at sim time 0
  double speed_mps = 0.0;
  double heading_deg = 0.0;  // [deg] true, at sim time 0
  double cross_section_m2 = 1000.0;
  double height_m = 6.096;  // [m] of what returns above the ground; 20 ft
};

// Where up begins for a polygonal scene. ground: each of its objects stands on the ground below its middle, what lies
// flat follows the ground. anchor: all of it stands on the ground at its place. sea_level: its heights are MSL.
enum class SceneHeights : std::uint8_t { ground = 0, anchor = 1, sea_level = 2 };

// A polygonal scene: an OpenFlight file, or a folder of them.
struct Scene {
  std::string file;
  geo::GeoPoint place{kNotGiven, kNotGiven};  // of its origin; not given: as its header or its name says
  double heading_deg = 0.0;                   // [deg] true, where its y axis points
  SceneHeights heights = SceneHeights::ground;
  std::string without{};  // names of what is left out, apart by commas; `*` and `?` as in names of files
};

// Air at mean sea level, and what its gases do; ITU-R P.676 and P.835.
struct AtmosphereConfiguration {
  bool gases = true;              // they attenuate
  double temperature_c = 15.0;    // [deg C]
  double pressure_hpa = 1013.25;  // [hPa] of the dry air
  double water_g_m3 = 7.5;        // [g/m^3] density of water vapour
};

struct WorldConfiguration {
  LandConfiguration land;
  SeaConfiguration sea;
  RainConfiguration rain;
  AtmosphereConfiguration atmosphere;
  JammingConfiguration jamming;
  std::vector<Mover> movers;
  std::vector<Scene> scenes;
  BeaconConfiguration beacons;
};

}  // namespace yars::radar
