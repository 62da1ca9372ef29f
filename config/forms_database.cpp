#include "config/field.hpp"
#include "config/forms.hpp"

namespace yars::config {
namespace {

std::vector<SlotSchema> database_slots() {
  return {{.name = "latitude",
           .unit = "deg",
           .lowest = -90,
           .highest = 90,
           .binding = AngleSlot{nullptr, true},
           .purpose = "centre of the database of 1996"},
          {.name = "longitude",
           .unit = "deg",
           .lowest = -180,
           .highest = 180,
           .binding = AngleSlot{nullptr, false},
           .purpose = "centre of the database of 1996"},
          {.name = "elevation",
           .unit = "ft",
           .lowest = -1500,
           .highest = 30'000,
           .binding = NumberSlot{},
           .purpose = "centre of the database of 1996"},
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

}  // namespace

std::vector<FormSchema> database_forms() {
  return {{.name = "Database", .purpose = "any terrain database", .slots = database_slots()},
          {.name = "DedDbase",
           .base = "Database",
           .purpose = "elevation files",
           .slots = with_base(database_slots(), {path_slot()})},
          {.name = "MgDbase",
           .base = "Database",
           .purpose = "polygons of the visual scene",
           .slots = with_base(database_slots(),
                              {{.name = "files", .binding = TextSlot{}, .purpose = "polygon file of 1996"},
                               {.name = "path", .binding = TextSlot{}, .purpose = "folder of the polygon file"}})},
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
