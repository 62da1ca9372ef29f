// Configuration of the world: surface materials, sea, rain, atmosphere, jammers, beacons, moving targets, scenes.
// config/schema reads the values from GUF files. The defaults equal those of the GUF forms.
// Units: as the suffix of each name says. Positions are WGS84; altitudes are above mean sea level.
// Source: docs/spec/physics.md#power-and-video.
#pragma once

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/modes.hpp"
#include "lib/values/defaults.hpp"

namespace yars::radar {

// The following limits bound the work of one sweep.
using values::kMaxJammers;
using values::kMaxMovers;
using values::kMaxRainCells;
inline constexpr int kMaxBeacons = 64;
inline constexpr int kMaxReplies = 6;  // replies of a beacon to one pulse
inline constexpr int kMaxScenes = 1024;

// Return of a surface material: sigma0 = gamma sin(grazing angle).
struct Material {
  int code = 0;  // 1 to 31, except water
  std::string name;
  double gamma_db = 0.0;     // [dB] gamma at LandConfiguration::reference_frequency_ghz
  double cardinal_db = 0.0;  // [dB] cardinal effect: additional return of walls that face the radar
  // Shape parameter of the gamma-distributed texture. A smaller shape varies more; 0: none; kNotGiven: by grazing angle
  // and resolution cell (docs/spec/physics.md#texture).
  double texture = kNotGiven;
};

// Return of land. The gamma of land without culture is ReceiverConfiguration::land_gamma_db.
struct LandConfiguration {
  double frequency_slope_db = 5.0;        // [dB] increase of every gamma for a tenfold frequency
  double reference_frequency_ghz = 10.0;  // [GHz] frequency at which the configured gammas apply
  double cardinal_width_deg = 6.0;        // [deg] half-power width of the cardinal effect
  double texture = kNotGiven;             // texture of land without culture, as Material::texture
  std::vector<Material> materials{
      {1, "metal", 5.0, 12.0, 1.5},    {2, "part metal", 2.0, 10.0, 2.0},
      {3, "stone", 0.0, 10.0, 3.0},    {4, "composition", -3.0, 8.0, 4.0},
      {5, "earthen works", -8.0, 0.0}, {7, "sand", -22.0, 0.0},
      {8, "rock", -8.0, 0.0},          {9, "asphalt and concrete", -28.0, 0.0},
      {10, "soil", -17.0, 0.0},        {11, "marsh", -16.0, 0.0},
      {12, "trees", -12.0, 0.0},       {13, "snow and ice", -20.0, 0.0}};  // ascending codes
};

// Return of the sea. Source: Gregers-Hansen and Mital, NRL 2012 (DTIC ADA559494), table 2, coefficients c1 to c5.
struct SeaConfiguration {
  double state = kNotGiven;  // sea state, WMO code 3700; kNotGiven: from the wind speed
  double wind_speed_mps = values::WorldStateDefaults::wind_speed_mps;
  double wind_from_deg = values::WorldStateDefaults::wind_from_deg;  // [deg] true direction that the wind comes from
  Polarization polarization = Polarization::horizontal;
  std::vector<double> horizontal{-73.0, 20.781, 7.351, 25.65, 0.0054};
  std::vector<double> vertical{-50.796, 25.93, 0.7093, 21.588, 0.00211};
  double wind_factor = 0.2;  // factor of the upwind term of the GIT sea clutter model; 0 = no effect of wind direction
  // Shape parameter of the gamma-distributed texture; 0: none; kNotGiven: by grazing angle, resolution cell, wind and
  // polarization (docs/spec/physics.md#sea). Patch maps then have kMapTexture.
  double texture = kNotGiven;
  static constexpr double kMapTexture = 4.0;
  // nathanson: with a correction fitted to Nathanson's table at 9.3 GHz, for 8 to 12 GHz (docs/spec/physics.md#sea)
  SeaModel model = SeaModel::nrl;
  double texture_life_s = 5.0;  // the texture moves with the waves and lives for this time; 0: fixed to the ground
  bool specular = true;         // echo of facets normal to the ray, above 60 degrees grazing
};

// Rain cell (shower): a vertical cylinder. Return and attenuation of the rain are greatest at the axis. They are zero
// at the rim and above the top.
struct RainCell {
  using Values = values::WorldRainCell;  // lib/values/fields.hpp
  geo::GeoPoint position;
  double radius_m = values::WorldRainCellDefaults::radius_m;
  double rate_mmh = values::WorldRainCellDefaults::rate_mmh;  // at the axis
  double top_m = values::WorldRainCellDefaults::top_m;        // above mean sea level
};

struct RainConfiguration {
  // Reflectivity Z = a r^b [mm^6/m^3] and attenuation k r^b [dB/km, one way] at the rain rate r [mm/h].
  double reflectivity_factor = 200.0;  // a of Z; Marshall and Palmer 1948
  double reflectivity_exponent = 1.6;  // b of Z
  double dielectric_factor = 0.93;     // |K|^2 of water
  // k and b of the attenuation; kNotGiven: by ITU-R P.838-3 at the radar's frequency and SeaConfiguration::polarization
  double attenuation_factor = kNotGiven;
  double attenuation_exponent = kNotGiven;
  std::vector<RainCell> cells;
};

inline constexpr int kChannels = 8;    // frequency channels of the radar
inline constexpr int kEveryBand = -1;  // Jammer::band of a jammer in all bands

// Noise jammer. On the display the jammer causes a strobe, a bright line in its direction.
struct Jammer {
  using Values = values::WorldJammer;  // lib/values/fields.hpp
  std::string name;
  geo::GeoPoint position;
  double altitude_m = kNotGiven;                          // [m] above mean sea level; kNotGiven: 10 m above ground
  int band = kEveryBand;                                  // 0 to 4 are bands A to E
  std::vector<double> channels{1, 2, 3, 4, 5, 6, 7, 8};   // jammed channels, ascending
  double power_w = values::WorldJammerDefaults::power_w;  // effective radiated power in the receiver's bandwidth
};

struct JammingConfiguration {
  double radar_power_dbw = 72.0;  // [dBW] effective radiated peak power of the radar
  double sidelobe_db = -35.0;     // [dB] lower bound of the one-way antenna gain, relative to the beam centre
  std::vector<Jammer> jammers;
};

// Radar beacon on the ground. It replies to a pulse of its code with a train of pulses.
struct Beacon {
  std::string name;
  geo::GeoPoint position;
  double altitude_m = kNotGiven;  // [m] above mean sea level; kNotGiven: 10 m above ground
  int code = 1;                   // interrogation code to which the beacon replies
  double delay_us = 2.0;          // [us] from the received pulse to the first reply
  int replies = 2;                // number of replies, 2 to kMaxReplies
  double spacing_us = 10.0;       // [us] between replies; identifies the beacon
  double power_w = 100.0;         // [W] effective radiated power
};

struct BeaconConfiguration {
  int code = 1;  // interrogation code that the radar sends
  std::vector<Beacon> beacons;
};

// Moving target or corner reflector: a point that follows a geodesic at constant speed.
struct Mover {
  using Values = values::WorldMover;  // lib/values/fields.hpp
  std::string name{};
  geo::GeoPoint position{};                                      // position at sim time `since`
  double speed_mps = values::WorldMoverDefaults::speed_mps;      // over ground
  double heading_deg = values::WorldMoverDefaults::heading_deg;  // true direction of motion at sim time `since`
  double cross_section_m2 = values::WorldMoverDefaults::cross_section_m2;
  double height_m = values::WorldMoverDefaults::height_m;  // height of the scatterer above the ground
  geo::Duration since{};                                   // sim time; the configuration has 0
  TargetEcho echo = TargetEcho::swerling1;
  int facing_deg = 0;  // true azimuth of a reflector's axis
  int tilt_deg = 0;    // elevation of a reflector's axis
  // Given instead of the cross section, which the configuration then computes (lib/radar/cross_section.hpp).
  double displacement_t = kNotGiven;  // [t] of a ship, full load
  double edge_m = kNotGiven;          // of a reflector
};

// Polygonal scene of the OpenFlight format.
struct Scene {
  std::string file;                              // an OpenFlight file, or a folder of them
  geo::GeoPoint position{kNotGiven, kNotGiven};  // position of the origin; kNotGiven: from the file's name or header
  double heading_deg = 0.0;                      // [deg] true direction of the scene's y axis
  SceneHeights heights = SceneHeights::ground;
  std::string without{};  // names of omitted objects and groups, separated by commas; `*` and `?` are wildcards
};

// Atmosphere at mean sea level. Source: ITU-R P.676 (attenuation by gases), P.835 (profile with height), P.453
// (refractivity; its profile falls exponentially with height).
struct AtmosphereConfiguration {
  bool gases = true;                    // true: oxygen and water vapour attenuate
  double temperature_c = 15.0;          // [deg C]
  double pressure_hpa = 1013.25;        // [hPa] of dry air and water vapour together
  double water_g_m3 = 7.5;              // [g/m^3] density of water vapour
  double refractivity = 313.0;          // [N-units] (index of refraction - 1) times a million
  double refractivity_per_km = 0.1439;  // [1/km] it falls as exp(-refractivity_per_km height)
  std::string profile{};  // file of a radiosonde; the configuration reads both values above from it, and empties this
};

struct TerrainConfiguration {
  std::string directory;            // folder of the elevation files; empty: built-in analytic hills
  bool missing_cell_is_sea = true;  // true: a cell without a file is sea at 0 m; false: it is void
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

// The lists of a world whose entries an instructor changes, too (lib/values/world_state.idl).
template <class World>
auto lists_of(World& world) {
  return std::tie(world.rain.cells, world.jamming.jammers, world.movers);
}

// An entry of each of these lists.
struct ListEntries {
  template <class... Lists>
  static std::tuple<typename Lists::value_type...> entries_of(std::tuple<Lists&...> lists);
  decltype(entries_of(lists_of(std::declval<WorldConfiguration&>()))) of;
};

// Which parts of the world that an instructor changes at run time differ between two worlds.
struct WorldChanges {
  bool sea = false;  // sea state or wind
  bool rain = false;
  bool jammers = false;
  bool movers = false;

  bool any() const { return sea || rain || jammers || movers; }
};
WorldChanges changes_between(const WorldConfiguration& before, const WorldConfiguration& after);

}  // namespace yars::radar
