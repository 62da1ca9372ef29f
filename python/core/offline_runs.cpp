#include "python/core/offline_runs.hpp"

#include <pybind11/stl.h>

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "python/core/calls.hpp"
#include "python/core/places.hpp"
#include "python/core/radar_class.hpp"
#include "radar/failure.hpp"
#include "radar/stores.hpp"
#include "tools/command/output.hpp"
#include "tools/scene/generate_command.hpp"
#include "tools/terrain/generate_command.hpp"
#include "tools/trade/trade_command.hpp"

namespace yars::python {

namespace {

// JSON that `yars trade --out` writes. Null terrain: that of the radar's configuration, else the built-in hills.
template <class Request>
std::string trade(const std::shared_ptr<Terrain>& terrain, const Radar& radar, const Request& request,
                  const std::string& csv, const std::string& out) {
  tools::check_file_name("out", out, {".json"});
  tools::check_file_name("csv", csv, {".csv"});
  radar::RadarConfiguration configuration = radar.radar().configuration();
  if (terrain) configuration.terrain = terrain->terrain().stores()->configuration();
  Warnings warnings;
  std::string text;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const tools::TradeResult result = tools::measure_trade(request, configuration, warnings.sink(), goes_on);
    tools::write_trade_files(csv, out, result);
    text = tools::json_text(result);
  });
  warnings.show("yars.trade");
  return text;
}

// Throws if the folder has cells that are not of this landscape's area and level.
void check_other_cells(const std::string& folder, const TerrainGeneration& request) {
  namespace terrain = model::terrain;
  const auto index = terrain::index_directory(folder);
  if (!index) return;  // no folder, or no cells
  for (const auto& [slot, file] : *index) {
    const terrain::CellCorner corner = terrain::corner_of_slot(slot);
    const int rows = corner.south_deg - request.south;
    const int columns = (corner.west_deg - request.west + 720) % 360;
    if (rows >= 0 && rows < request.cells_lat && columns < request.cells_lon &&
        file.path == std::filesystem::path(folder) / terrain::dted_name(corner, request.level))
      continue;
    radar::fail(error::usage_error("directory", "a folder without cells of another area or level", file.path.string(),
                                   "give another folder, or remove it"));
  }
}

void generate_terrain(const std::string& folder, const TerrainGeneration& request) {
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    tools::check_folder_name("directory", folder);
    check_other_cells(folder, request);
    tools::generate_terrain_files(folder, request, goes_on);
  });
}

// `origin`: LAT, LON or LAT, LON, HDG [deg] as numbers, or as a text with commas between them.
void generate_scene(const std::string& file, const SceneGeneration& request,
                    const std::variant<std::vector<double>, std::string>& origin) {
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    tools::check_file_name("path", file, {".flt"});
    const auto* const text = std::get_if<std::string>(&origin);
    auto position = text != nullptr ? model::scene::parse_scene_position(*text)
                                    : model::scene::scene_position(std::get<std::vector<double>>(origin));
    if (!position) position.error().subject = "origin";
    tools::generate_scene_file(file, request, value_of(std::move(position)), goes_on);
  });
}

}  // namespace

void add_offline_runs(py::module_& module) {
  module.def("generate_terrain", &generate_terrain, py::arg("directory"), py::arg("request"));
  module.def("generate_scene", &generate_scene, py::arg("path"), py::arg("request"), py::arg("origin"));
  module.def("trade", &trade<ScanTradeRequest>);
  module.def("trade", &trade<MapTradeRequest>);
}

}  // namespace yars::python
