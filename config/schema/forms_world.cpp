// Forms of the configuration language GUF with their slots (schema.hpp): terrain, land, sea, rain and atmosphere.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "config/guf/parser.hpp"
#include "config/schema/list_forms.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/radar/world.hpp"

namespace yars::config {

namespace {

constexpr std::string_view kStatedByFiles =
    "elevation files state their place and their heights; path names their folder";
constexpr std::string_view kByScan = "files are read as far as the range, and as fine as samples of Fidelity";

// Slots of Database and of the forms that extend it. Only MgDbase uses the position, because elevation files contain
// their positions.
std::vector<SlotSchema> database_slots(AngleSlot latitude = {nullptr, true}, AngleSlot longitude = {nullptr, false}) {
  return {{.name = "latitude",
           .unit = "deg",
           .lowest = -90,
           .highest = 90,
           .binding = latitude,
           .purpose = "centre of the database",
           .instead = kStatedByFiles},
          {.name = "longitude",
           .unit = "deg",
           .lowest = -180,
           .highest = 180,
           .binding = longitude,
           .purpose = "centre of the database",
           .instead = kStatedByFiles},
          {.name = "elevation",
           .unit = "ft",
           .lowest = -1500,
           .highest = 30'000,
           .binding = NumberSlot{},
           .purpose = "elevation of the centre of the database",
           .instead = "the ground has the heights of its files; heights of Scene says where a scene stands"},
          {.name = "samples",
           .lowest = 1,
           .highest = 65'536,
           .binding = IntegerSlot{},
           .purpose = "samples of the database of 1996",
           .instead = kByScan},
          {.name = "range",
           .unit = "m",
           .lowest = 0,
           .highest = 1e7,
           .binding = NumberSlot{},
           .purpose = "radius of the database of 1996",
           .instead = kByScan}};
}

SlotSchema path_slot() {
  return {.name = "path",
          .binding = PathSlot{YARS_FIELD(radar.terrain.directory)},
          .purpose = "folder of the elevation files",
          .same_as = "directory of Terrain"};
}

void begin_polygons(ConfigurationBuilder& builder) {
  builder.scene = {};
  builder.scene_folder.clear();
}

std::optional<ConstraintViolation> check_polygons(const ConfigurationBuilder& builder) {
  if (builder.scene_folder.empty() && !builder.scene.file.empty())
    return ConstraintViolation{"path", "the folder of the polygon file", "none"};
  if (builder.radar.world.scenes.size() >= radar::kMaxScenes)
    return ConstraintViolation{"path", "at most " + std::to_string(radar::kMaxScenes) + " scenes", "one more"};
  if (std::isnan(builder.scene.position.latitude_deg) == std::isnan(builder.scene.position.longitude_deg))
    return std::nullopt;
  return ConstraintViolation{"latitude", "latitude and longitude together, or neither", "one of them"};
}

// Adds the polygons as a scene. If there is a scene of the same file, none is added, because a configuration can name a
// database several times.
void end_polygons(ConfigurationBuilder& builder) {
  if (builder.scene_folder.empty()) return;
  builder.scene.file = (std::filesystem::path(builder.scene_folder) / builder.scene.file).string();
  auto& scenes = builder.radar.world.scenes;
  const bool known = std::any_of(scenes.begin(), scenes.end(),
                                 [&](const radar::Scene& scene) { return scene.file == builder.scene.file; });
  if (!known) scenes.push_back(builder.scene);
}

FormSchema polygons() {
  return {.name = "MgDbase",
          .base = "Database",
          .purpose = "polygons of the visual scene, added to Scenes",
          .slots = with_base(database_slots({YARS_FIELD(scene.position.latitude_deg), true},
                                            {YARS_FIELD(scene.position.longitude_deg), false}),
                             {{.name = "files",
                               .binding = TextSlot{YARS_FIELD(scene.file)},
                               .purpose = "OpenFlight file in the folder; left out: all .flt files in it",
                               .same_as = "file of Scene"},
                              {.name = "path",
                               .binding = PathSlot{YARS_FIELD(scene_folder)},
                               .purpose = "folder of the polygon files",
                               .same_as = "file of Scene"}}),
          .begin = begin_polygons,
          .check = check_polygons,
          .end = end_polygons};
}

}  // namespace

std::vector<FormSchema> database_forms() {
  return {
      {.name = "Database", .purpose = "any terrain database", .slots = database_slots()},
      {.name = "DedDbase",
       .base = "Database",
       .purpose = "elevation files",
       .slots = with_base(database_slots(), {path_slot()})},
      polygons(),
      {.name = "Terrain",
       .purpose = "source of the elevations",
       .slots = {{.name = "directory",
                  .binding = PathSlot{YARS_FIELD(radar.terrain.directory)},
                  .purpose = "folder of elevation cells: DTED, HGT, DED, packs (`yars terrain pack`), rasters (GDAL); "
                             "empty: built-in hills"},
                 {.name = "missingCellIsSea",
                  .binding = BooleanSlot{YARS_FIELD(radar.terrain.missing_cell_is_sea)},
                  .purpose = "a cell without a file is sea; false: it is void"}}}};
}

namespace {

using radar::kNotGiven;

constexpr std::array<std::string_view, 2> kSeaModels{"nrl", "nathanson"};            // order of radar::SeaModel
constexpr std::array<std::string_view, 2> kPolarizations{"horizontal", "vertical"};  // order of radar::Polarization

FormSchema land() {
  return {
      .name = "Land",
      .purpose = "radar return of land: sigma0 = gamma sin(grazing angle)",
      .slots = {
          number_slot("frequencySlope", "dB", -20, 20, {YARS_FIELD(radar.world.land.frequency_slope_db)},
                      "increase of every gamma for a tenfold frequency"),
          number_slot("referenceFrequency", "GHz", 1, 40, {YARS_FIELD(radar.world.land.reference_frequency_ghz)},
                      "frequency for which the gammas are given"),
          number_slot("streetWidth", "deg", 0.1, 45, {YARS_FIELD(radar.world.land.cardinal_width_deg)},
                      "cardinal effect (stronger return of walls that face the radar): full width at half power"),
          number_slot(
              "texture", "", 0, 100, {YARS_FIELD(radar.world.land.texture)},
              "shape parameter of the texture of land without material; small = spiky, 0 = none; left out: by grazing "
              "angle and resolution cell")}};
}

std::optional<ConstraintViolation> check_material(const ConfigurationBuilder& builder) {
  if (builder.material.code == 0) return ConstraintViolation{"code", "a code of 1 to 31", "none"};
  if (builder.material.code != radar::kWaterMaterial) return std::nullopt;
  return ConstraintViolation{"code", "a code other than 6 (water; the form Sea sets its return)", "6"};
}

// Adds a material, or changes the one with the same code. Omitted slots keep their value. In a new material they are 0
// or empty, and the texture is not given.
void end_material(ConfigurationBuilder& builder) {
  auto& materials = builder.radar.world.land.materials;
  const radar::Material& given = builder.material;
  const auto row = std::lower_bound(materials.begin(), materials.end(), given.code,
                                    [](const radar::Material& one, int code) { return one.code < code; });
  const bool known = row != materials.end() && row->code == given.code;
  radar::Material merged = known ? *row : radar::Material{.code = given.code, .name = {}};
  if (!given.name.empty()) merged.name = given.name;
  if (!std::isnan(given.gamma_db)) merged.gamma_db = given.gamma_db;
  if (!std::isnan(given.cardinal_db)) merged.cardinal_db = given.cardinal_db;
  if (!std::isnan(given.texture)) merged.texture = given.texture;
  if (known) {
    *row = std::move(merged);
  } else {
    materials.insert(row, std::move(merged));
  }
}

FormSchema material() {
  return {.name = "Material",
          .purpose = "radar return of a surface material",
          .slots =
              {{.name = "code",
                .lowest = 1,
                .highest = radar::kMaterials - 1,
                .binding = IntegerSlot{YARS_FIELD(material.code)},
                .purpose = "surface material code of the culture; 0 is land without culture, 6 is water"},
               {.name = "name", .binding = TextSlot{YARS_FIELD(material.name)}, .purpose = "name, free text"},
               number_slot("gamma", "dB", -60, 30, {YARS_FIELD(material.gamma_db)},
                           "gamma: sigma0 = gamma sin(grazing angle); left out: 0 in a new material, else unchanged"),
               number_slot("cardinal", "dB", 0, 30, {YARS_FIELD(material.cardinal_db)},
                           "additional return of walls that face the radar; left out: 0 in a new material, else "
                           "unchanged"),
               number_slot(
                   "texture", "", 0, 100, {YARS_FIELD(material.texture)},
                   "shape parameter of its texture; small = spiky, 0 = none; left out: unchanged, in a new material by "
                   "grazing angle and resolution cell")},
          .part_of_value = true,
          .begin =
              [](ConfigurationBuilder& builder) {
                builder.material = {
                    .code = 0, .name = {}, .gamma_db = kNotGiven, .cardinal_db = kNotGiven, .texture = kNotGiven};
              },
          .check = check_material,
          .end = end_material,
          .count = [](const ConfigurationBuilder& builder) { return builder.radar.world.land.materials.size(); },
          .select = [](ConfigurationBuilder& builder,
                       std::size_t index) { builder.material = builder.radar.world.land.materials[index]; }};
}

SlotSchema sea_coefficients(std::string_view name, std::vector<double>& (*of)(ConfigurationBuilder&)) {
  return {.name = name,
          .lowest = -200,
          .highest = 200,
          .binding = ListSlot{of, 5, 5, Order::any},
          .purpose = "c1 to c5 of the NRL model (2012) for this polarization"};
}

FormSchema sea() {
  return {
      .name = "Sea",
      .purpose = "radar return of the sea: the NRL model, with the wind direction factor of the GIT model",
      .slots =
          {value_slot("state", values::WorldState::sea_state, YARS_FIELD(radar.world.sea.state)),
           value_slot("windSpeed", values::WorldState::wind_speed, YARS_FIELD(radar.world.sea.wind_speed_mps)),
           value_slot("windFrom", values::WorldState::wind_from, YARS_FIELD(radar.world.sea.wind_from_deg)),
           {.name = "polarization",
            .binding = ChoiceSlot{
                kPolarizations,
                [](const ConfigurationBuilder& builder) { return int(builder.radar.world.sea.polarization); },
                [](ConfigurationBuilder& builder, int index) {
                  builder.radar.world.sea.polarization = radar::Polarization(index);
                }},
            .purpose = "polarization of the radar"},
           sea_coefficients("horizontal", YARS_FIELD(radar.world.sea.horizontal)),
           sea_coefficients("vertical", YARS_FIELD(radar.world.sea.vertical)),
           number_slot("windFactor", "", 0, 2, {YARS_FIELD(radar.world.sea.wind_factor)},
                       "wind direction factor; 0.2: at small grazing angles 3 dB more upwind and 3 dB less "
                       "downwind at X band; 0: no effect"),
           number_slot(
               "texture", "", 0, 100, {YARS_FIELD(radar.world.sea.texture)},
               "shape parameter of the sea's texture; small = spiky, 0 = none; left out: by grazing angle, resolution "
               "cell, wind and polarization, in patch maps 4"),
           {.name = "model",
            .binding = ChoiceSlot{
                kSeaModels, [](const ConfigurationBuilder& builder) { return int(builder.radar.world.sea.model); },
                [](ConfigurationBuilder& builder, int index) {
                  builder.radar.world.sea.model = radar::SeaModel(index);
                }},
            .purpose = "nathanson: the NRL model with a correction fitted to Nathanson's table of X band, for "
                       "frequencies of Receiver from 8 to 12 GHz"},
           number_slot("textureLife", "s", 0, 3600, {YARS_FIELD(radar.world.sea.texture_life_s)},
                       "the texture moves with the waves, and a patch of it lasts so long; 0: fixed to the ground"),
           {.name = "specular",
            .binding = BooleanSlot{YARS_FIELD(radar.world.sea.specular)},
            .purpose = "echo of level facets of the sea, above 60 degrees of grazing angle, by the wind"}},
      .check_at_end = check_sea_model};
}

FormSchema rain() {
  FormSchema form = list_form<radar::RainCell>(
      "cells",
      {number_slot("reflectivityFactor", "", 0, 2000, {YARS_FIELD(radar.world.rain.reflectivity_factor)},
                   "a of Z = a r^b, Z in mm^6/m^3, rain rate r in mm/h (Marshall and Palmer)"),
       number_slot("reflectivityExponent", "", 0.5, 3, {YARS_FIELD(radar.world.rain.reflectivity_exponent)},
                   "b of Z = a r^b"),
       number_slot("dielectricFactor", "", 0, 1, {YARS_FIELD(radar.world.rain.dielectric_factor)},
                   "squared magnitude of the dielectric factor K; 0.93 for water, 0.2 for ice"),
       number_slot(
           "attenuationFactor", "dB/km", 0, 10, {YARS_FIELD(radar.world.rain.attenuation_factor)},
           "k of the attenuation k r^b, one way; left out: ITU-R P.838-3 at the radar's frequency and the polarization "
           "of Sea"),
       number_slot("attenuationExponent", "", 0.5, 3, {YARS_FIELD(radar.world.rain.attenuation_exponent)},
                   "b of k r^b; left out: as attenuationFactor")});
  form.purpose = "rain cells, and echo and attenuation of rain";
  return form;
}

FormSchema atmosphere() {
  return {.name = "Atmosphere",
          .purpose = "the air at mean sea level, attenuation by its gases (ITU-R P.676-13, P.835), and its refraction",
          .slots = {{.name = "gases",
                     .binding = BooleanSlot{YARS_FIELD(radar.world.atmosphere.gases)},
                     .purpose = "oxygen and water vapour attenuate; not with the preset 1996"},
                    number_slot("temperature", "deg C", -60, 60, {YARS_FIELD(radar.world.atmosphere.temperature_c)},
                                "temperature at mean sea level; falls by 6.5 degrees per km up to 11 km"),
                    number_slot("pressure", "hPa", 500, 1100, {YARS_FIELD(radar.world.atmosphere.pressure_hpa)},
                                "pressure at mean sea level, of dry air and water vapour together"),
                    number_slot("waterVapour", "g/m3", 0, 50, {YARS_FIELD(radar.world.atmosphere.water_g_m3)},
                                "density at mean sea level; falls to 1/e every 2 km"),
                    number_slot("refractivity", "", 0, 450, {YARS_FIELD(radar.world.atmosphere.refractivity)},
                                "at mean sea level, in N-units: a millionth of the index of refraction above 1"),
                    number_slot("refractivityPerKm", "1/km", 0.05, 0.25,
                                {YARS_FIELD(radar.world.atmosphere.refractivity_per_km)},
                                "c of the fall exp(-c height) of the refractivity"),
                    {.name = "profile",
                     .binding = PathSlot{YARS_FIELD(radar.world.atmosphere.profile)},
                     .purpose = "CSV file of a radiosonde; refractivity and refractivityPerKm are those of the "
                                "exponential profile that fits it best"}}};
}

}  // namespace

std::optional<ConstraintViolation> check_sea_model(const ConfigurationBuilder& builder) {
  const double frequency_ghz = builder.radar.receiver.frequency_ghz;
  const bool x_band = frequency_ghz >= 8.0 && frequency_ghz <= 12.0;
  if (x_band || builder.radar.world.sea.model != radar::SeaModel::nathanson) return std::nullopt;
  return ConstraintViolation{"", "a frequency of Receiver from 8 to 12 GHz for :model nathanson of Sea",
                             number_text(frequency_ghz)};
}

std::vector<FormSchema> world_forms() {
  return {land(),
          {.name = "Materials",
           .purpose = "radar return of surface materials; adds to the built-in materials, or changes them by code",
           .slots = {{.name = "materials",
                      .binding = FormSlot{{"Material"}, {"Material"}, true},
                      .purpose = "materials of culture"}}},
          material(),
          sea(),
          rain(),
          atmosphere()};
}

}  // namespace yars::config
