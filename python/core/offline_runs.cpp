#include "python/core/offline_runs.hpp"

#include <pybind11/stl.h>

#include <filesystem>

#include "lib/radar/configuration.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "python/core/calls.hpp"
#include "radar/stores.hpp"
#include "tools/scene/generate_command.hpp"
#include "tools/terrain/generate_command.hpp"
#include "tools/trade/trade_command.hpp"

namespace yars::python {

namespace {

template <class Options, class AddOptions>
std::string measured(const AddOptions& add_options, const std::shared_ptr<Terrain>& terrain, const Radar& radar,
                     const std::vector<std::string>& words) {
  Options options;
  read_options("yars.trade", words, [&](runtime::Command line) { add_options(line, options); });
  tools::check_trade_output(options);
  radar::RadarConfiguration configuration = radar.radar().configuration();
  tools::apply_options(options.configuration, configuration);
  if (terrain) configuration.terrain = terrain->terrain().stores()->configuration();
  Warnings warnings;
  std::string text;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const tools::TradeResult result = tools::measure_trade(options, configuration, warnings.sink(), goes_on);
    tools::write_trade_files(options, result);
    text = tools::json_text(result);
  });
  warnings.show("yars.trade");
  return text;
}

// Throws ValueError if the folder has cells that are not of this landscape's area and level.
void check_other_cells(const tools::TerrainGenerateOptions& options) {
  namespace terrain = model::terrain;
  const auto index = terrain::index_directory(options.out);
  if (!index) return;  // no folder, or no cells
  for (const auto& [slot, file] : *index) {
    const terrain::CellCorner corner = terrain::corner_of_slot(slot);
    const int rows = corner.south_deg - options.south_deg;
    const int columns = (corner.west_deg - options.west_deg + 720) % 360;
    if (rows >= 0 && rows < options.cells_latitude && columns < options.cells_longitude &&
        file.path == std::filesystem::path(options.out) / terrain::dted_name(corner, options.level))
      continue;
    raise_value_error(
        "yars.Terrain.generate: directory: expected a folder without cells of another area or level, found " +
        file.path.string() + "; give another folder, or remove it");
  }
}

}  // namespace

void generate_scene(const std::vector<std::string>& words) {
  tools::SceneGenerateOptions options;
  read_options("yars.Scene.generate", words,
               [&](runtime::Command line) { tools::add_scene_generate_options(line, options); });
  without_interpreter([&](const parallel::GoesOn& goes_on) { tools::generate_scene_file(options, goes_on); });
}

void generate_terrain(const std::vector<std::string>& words) {
  tools::TerrainGenerateOptions options;
  read_options("yars.Terrain.generate", words,
               [&](runtime::Command line) { tools::add_terrain_generate_options(line, options); });
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    check_other_cells(options);
    tools::generate_terrain_files(options, goes_on);
  });
}

std::string trade(bool maps, const std::shared_ptr<Terrain>& terrain, const Radar& radar,
                  const std::vector<std::string>& words) {
  if (maps) return measured<tools::MapTradeOptions>(tools::add_map_trade_options, terrain, radar, words);
  return measured<tools::ScanTradeOptions>(tools::add_scan_trade_options, terrain, radar, words);
}

void add_offline_runs(py::module_& module) {
  module.def("generate_terrain", &generate_terrain, py::arg("words"));
  module.def("generate_scene", &generate_scene, py::arg("words"));
  module.def("trade", &trade, py::arg("maps"), py::arg("terrain").none(true), py::arg("radar"), py::arg("words"));
}

}  // namespace yars::python
