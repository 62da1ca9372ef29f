#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "config/field.hpp"
#include "config/forms.hpp"

namespace yars::config {
namespace {

// Terrain cells carry their place; a scene may have to be told its own.
std::vector<SlotSchema> database_slots(AngleSlot latitude = {nullptr, true}, AngleSlot longitude = {nullptr, false}) {
  return {{.name = "latitude",
           .unit = "deg",
           .lowest = -90,
           .highest = 90,
           .binding = latitude,
           .purpose = "centre of the database"},
          {.name = "longitude",
           .unit = "deg",
           .lowest = -180,
           .highest = 180,
           .binding = longitude,
           .purpose = "centre of the database"},
          {.name = "elevation",
           .unit = "ft",
           .lowest = -1500,
           .highest = 30'000,
           .binding = NumberSlot{},
           .purpose = "centre of the database"},
          {.name = "samples",
           .lowest = 1,
           .highest = 65'536,
           .binding = IntegerSlot{},
           .purpose = "samples of the database of 1996"},
          {.name = "range",
           .unit = "m",
           .lowest = 0,
           .highest = 1e7,
           .binding = NumberSlot{},
           .purpose = "reach of the database of 1996"}};
}

SlotSchema path_slot() {
  return {.name = "path",
          .binding = PathSlot{YARS_FIELD(radar.terrain.directory)},
          .purpose = "folder of the elevation files",
          .same_as = "directory of Terrain"};
}

void begin_polygons(Draft& draft) {
  draft.scene = {};
  draft.scene_folder.clear();
}

std::optional<Complaint> check_polygons(const Draft& draft) {
  if (draft.scene_folder.empty() && !draft.scene.file.empty())
    return Complaint{"path", "the folder of the polygon file", "none"};
  if (draft.radar.world.scenes.size() >= radar::kMostScenes)
    return Complaint{"path", "at most " + std::to_string(radar::kMostScenes) + " scenes", "one more"};
  if (std::isnan(draft.scene.place.latitude_deg) == std::isnan(draft.scene.place.longitude_deg)) return std::nullopt;
  return Complaint{"latitude", "latitude and longitude together, or neither", "one of them"};
}

// Polygons are a scene. A database that a file names for the radar and again for a mode is one.
void end_polygons(Draft& draft) {
  if (draft.scene_folder.empty()) return;
  draft.scene.file = (std::filesystem::path(draft.scene_folder) / draft.scene.file).string();
  auto& scenes = draft.radar.world.scenes;
  const bool known = std::any_of(scenes.begin(), scenes.end(),
                                 [&](const radar::Scene& scene) { return scene.file == draft.scene.file; });
  if (!known) scenes.push_back(draft.scene);
}

FormSchema polygons() {
  return {.name = "MgDbase",
          .base = "Database",
          .purpose = "polygons of the visual scene: one of Scenes",
          .slots = with_base(database_slots({YARS_FIELD(scene.place.latitude_deg), true},
                                            {YARS_FIELD(scene.place.longitude_deg), false}),
                             {{.name = "files",
                               .binding = TextSlot{YARS_FIELD(scene.file)},
                               .purpose = "OpenFlight file in the folder; left out: each .flt there",
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
  return {{.name = "Database", .purpose = "any terrain database", .slots = database_slots()},
          {.name = "DedDbase",
           .base = "Database",
           .purpose = "elevation files",
           .slots = with_base(database_slots(), {path_slot()})},
          polygons(),
          {.name = "Terrain",
           .purpose = "where the ground comes from",
           .slots = {{.name = "directory",
                      .binding = PathSlot{YARS_FIELD(radar.terrain.directory)},
                      .purpose = "folder of DTED and HGT files; empty: hills that are built in"},
                     {.name = "missingCellIsSea",
                      .binding = BooleanSlot{YARS_FIELD(radar.terrain.missing_cell_is_sea)},
                      .purpose = "a cell without a file is sea; false: it is void"}}}};
}

}  // namespace yars::config
