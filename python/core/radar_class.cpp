#include "python/core/radar_class.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "lib/file/text_file.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/text/plain_text.hpp"
#include "lib/values/fields.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "python/core/calls.hpp"
#include "python/core/places.hpp"
#include "radar/limits.hpp"
#include "radar/private_data.hpp"
#include "tools/command/command.hpp"
#include "tools/scene/generate_command.hpp"
#include "tools/terrain/generate_command.hpp"
#include "tools/trade/trade_command.hpp"

namespace yars::python {

Radar::Radar(const RadarSettings& settings) {
  Warnings warnings;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    radar_ = std::make_unique<yars::Radar>(value_of(yars::Radar::make(settings, warnings.call(goes_on))));
  });
  warnings.show("yars.Radar", 3);
}

std::shared_ptr<ScanResult> Radar::scan(const std::shared_ptr<Terrain>& terrain, const std::shared_ptr<Scene>& scene,
                                        const ScanRequest& request) const {
  Warnings warnings;
  std::optional<Scan> scan;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    scan =
        value_of(radar_->scan(terrain->terrain(), request, scene ? &scene->scene() : nullptr, warnings.call(goes_on)));
  });
  warnings.show("yars.Radar.scan");
  return std::make_shared<ScanResult>(std::move(*scan));
}

std::shared_ptr<PatchResult> Radar::patch(const std::shared_ptr<Terrain>& terrain, const std::shared_ptr<Scene>& scene,
                                          const PatchRequest& request) const {
  Warnings warnings;
  std::optional<Patch> patch;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    patch =
        value_of(radar_->patch(terrain->terrain(), request, scene ? &scene->scene() : nullptr, warnings.call(goes_on)));
  });
  warnings.show("yars.Radar.patch");
  return std::make_shared<PatchResult>(std::move(*patch));
}

py::dict Radar::patches(const std::shared_ptr<Terrain>& terrain, const py::array& orders, std::shared_ptr<Scene> scene,
                        const py::object& movers, const std::vector<std::string>& arrays, int threads, bool force,
                        int min_pixels) const {
  return patch_series(*radar_, *pool_, {terrain, std::move(scene), orders, movers, arrays, threads, force, min_pixels});
}

namespace {

// What a field takes, for Python: "number", "whole number", "truth value", "text", "texts", or the names of an
// enumeration.
template <class Value>
py::object kind_of(const values::Field& field) {
  if constexpr (std::is_same_v<Value, bool>) {
    return py::str("truth value");
  } else if constexpr (std::is_enum_v<Value>) {
    py::list names;
    for (const std::string_view name : field.values)
      if (!name.empty()) names.append(std::string(name));
    return py::tuple(names);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return py::str("text");
  } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
    return py::str("texts");
  } else {
    constexpr bool kReal = std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>;
    return py::str(kReal ? "number" : "whole number");
  }
}

// Sets a field. Python has checked the kind of the value; an enumeration's is its index.
template <class Value>
void set_field(Value& field, const py::handle& value) {
  if constexpr (std::is_enum_v<Value>)
    field = static_cast<Value>(py::cast<int>(value));
  else
    field = py::cast<Value>(value);
}

// Class of a request, whose constructor takes a dict, and the list of its fields: (name, kind, whether it may be
// None, least, greatest).
template <class Request>
void add_request(py::module_& module, const char* name) {
  py::class_<Request>(module, name).def(py::init([](const py::dict& given) {
    Request request;
    values::visit_fields(request, [&](const values::Field& field, auto& value) {
      const py::str key(field.name.data(), field.name.size());
      if (given.contains(key)) set_field(value, given[key]);
    });
    return request;
  }));
  py::list fields;
  Request request;
  values::visit_fields(request, [&](const values::Field& field, auto& value) {
    using Value = std::remove_reference_t<decltype(value)>;
    fields.append(py::make_tuple(std::string(field.name), kind_of<Value>(field), !field.otherwise.empty(), field.low,
                                 field.high));
  });
  module.attr((std::string(name) + "_fields").c_str()) = fields;
}

// Faults of a GUF text: dicts of what config::Fault has.
py::list guf_faults(const std::string& guf) {
  static constexpr std::array kKinds{"value", "form", "slot"};
  const text::DecimalPoint numbers;
  py::list all;
  using namespace pybind11::literals;
  for (const config::Fault& fault : config::faults_of_text(guf, "guf")) {
    const Error& error = fault.error;
    all.append(py::dict("kind"_a = kKinds[static_cast<std::size_t>(fault.kind)], "line"_a = fault.where.line,
                        "form"_a = fault.form, "slot"_a = fault.slot, "nearest"_a = fault.nearest,
                        "owner"_a = fault.owner, "expected"_a = error.expected, "found"_a = error.found,
                        "action"_a = error.action, "low"_a = error.low, "high"_a = error.high));
  }
  return all;
}

// What `yars config print FILE` prints. An empty path: the defaults.
std::string guf_of_file(const std::string& path) {
  const text::DecimalPoint numbers;
  const auto loaded = value_of(config::load_configuration(file::installed_file(path)));
  return config::print_configuration(loaded.radar) + (loaded.network ? config::print_network(*loaded.network) : "");
}

}  // namespace

void add_radar(py::module_& module) {
  module.def(
      "installed_file", [](const std::string& name) { return py::bytes(file::installed_file(name)); }, py::arg("name"),
      "Path of a file that came with YARS and is named without a folder; any other path as it is given.");
  module.def("guf_of_file", &guf_of_file, py::arg("path"), "The configuration of a file as GUF; \"\": the defaults.");
  module.def("guf_faults", &guf_faults, py::arg("text"), "Unknown names of a GUF text, and its first wrong value.");
  add_request<ScanRequest>(module, "ScanRequest");
  add_request<PatchRequest>(module, "PatchRequest");
  add_request<TerrainGeneration>(module, "TerrainGeneration");
  add_request<SceneGeneration>(module, "SceneGeneration");
  add_request<ScanTradeRequest>(module, "ScanTradeRequest");
  add_request<MapTradeRequest>(module, "MapTradeRequest");
  py::class_<Radar> type(module, "Radar");
  type.def("scan", &Radar::scan, py::arg("terrain").none(false), py::arg("scene").none(true), py::arg("request"))
      .def("patch", &Radar::patch, py::arg("terrain").none(false), py::arg("scene").none(true), py::arg("request"))
      .def("patches", &Radar::patches, py::arg("terrain").none(false), py::arg("orders"), py::arg("scene").none(true),
           py::arg("movers"), py::arg("arrays"), py::arg("threads"), py::arg("force"), py::arg("min_pixels"))
      .def_property_readonly("guf", [](const Radar& radar) { return radar.radar().guf(); })
      .def_property_readonly("limits",
                             [](const Radar& radar) {
                               const RadarLimits found = radar.radar().limits();
                               py::dict windows, limits;
                               for (const MapWindow& window : found.windows)
                                 windows[py::float_(window.window_nm)] =
                                     py::make_tuple(window.least_nm, window.greatest_nm);
                               limits["blind_zone_deg"] = found.blind_zone_deg;
                               limits["azimuth_deg"] = found.azimuth_deg;
                               limits["elevation_deg"] = found.elevation_deg;
                               limits["windows"] = windows;
                               limits["power_up_nm"] = found.power_up_nm;
                               limits["looks"] = found.looks;
                               return limits;
                             })
      .def_property_readonly("name", [](const Radar& radar) { return radar.radar().name(); })
      .def_property_readonly("fidelity", [](const Radar& radar) { return radar.radar().preset(); })
      .def_property_readonly("map_size", [](const Radar& radar) { return radar.radar().map_size(); })
      .def_property_readonly("samples", [](const Radar& radar) { return radar.radar().samples(); });
  seal(type);
  module.def(
      "make_radar",
      [](const std::string& preset, const std::string& config, const std::string& settings,
         const std::vector<std::pair<std::string, std::variant<bool, double, std::string>>>& knobs) {
        RadarSettings all{preset, config, settings, {}};
        for (const auto& [name, value] : knobs) all.knobs.push_back({name, value});
        return std::make_unique<Radar>(all);
      },
      py::arg("preset"), py::arg("config"), py::arg("settings"), py::arg("knobs"));
}

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
