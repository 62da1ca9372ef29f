#include "python/core/offline_runs.hpp"

#include "tools/scene/generate_command.hpp"
#include "tools/terrain/generate_command.hpp"
#include "tools/trade/trade_command.hpp"

namespace yars::python {

namespace {

// Arguments of a command with the file or folder that it writes as --out.
py::kwargs with_out(const char* function, const py::object& path, const py::kwargs& arguments) {
  py::kwargs all(py::reinterpret_steal<py::object>(PyDict_Copy(arguments.ptr())));
  for (const char* taken : {"out", "json"})
    if (all.contains(taken))
      raise_value_error(std::string(function) + ": expected the path as first argument, found " + taken);
  all["out"] = py::module_::import("os").attr("fspath")(path);
  return all;
}

template <class Options, class AddOptions>
std::string measured(const char* command, const AddOptions& add_options, const std::shared_ptr<Terrain>& terrain,
                     const Radar& radar, const py::kwargs& arguments) {
  Options options;
  read_options(command, arguments, [&](databuffer::Command line) { add_options(line, options); });
  check_arguments([&] { tools::check_trade_output(options); });
  radar::RadarConfiguration configuration = radar.configuration();
  tools::apply_options(options.configuration, configuration);
  if (terrain) configuration.terrain = terrain->configuration();
  Warnings warnings;
  std::string text;
  {
    const py::gil_scoped_release released;
    const tools::TradeResult result = tools::measure_trade(options, configuration, warnings.sink());
    tools::write_trade_files(options, result);
    text = tools::json_text(result);
  }
  warnings.show(command);
  return text;
}

}  // namespace

std::string generate_scene(const py::object& path, const py::kwargs& arguments) {
  py::kwargs all = with_out("yars.Scene.generate", path, arguments);
  // A position in Python's form, (latitude, longitude) or (latitude, longitude, heading), as the option's text.
  if (all.contains("origin") && !py::isinstance<py::str>(all["origin"])) {
    std::string text;
    for (const py::handle& number : py::reinterpret_borrow<py::object>(all["origin"]))
      text += (text.empty() ? "" : ",") +
              py::cast<std::string>(py::repr(py::float_(py::reinterpret_borrow<py::object>(number))));
    all["origin"] = text;
  }
  tools::SceneGenerateOptions options;
  read_options("yars scene generate", all,
               [&](databuffer::Command line) { tools::add_scene_generate_options(line, options); });
  const py::gil_scoped_release released;
  tools::generate_scene_file(options);
  return options.out;
}

std::string generate_terrain(const py::object& directory, const py::kwargs& arguments) {
  py::kwargs all = with_out("yars.Terrain.generate", directory, arguments);
  if (all.contains("culture") && py::reinterpret_borrow<py::object>(all["culture"]).ptr() == Py_False)
    all["no_culture"] = py::bool_(true);
  tools::TerrainGenerateOptions options;
  read_options("yars terrain generate", all,
               [&](databuffer::Command line) { tools::add_terrain_generate_options(line, options); });
  const py::gil_scoped_release released;
  tools::generate_terrain_files(options);
  return options.out;
}

std::string trade(bool maps, const std::shared_ptr<Terrain>& terrain, const Radar& radar, const py::kwargs& arguments) {
  if (maps)
    return measured<tools::MapTradeOptions>("yars trade maps", tools::add_map_trade_options, terrain, radar, arguments);
  return measured<tools::ScanTradeOptions>("yars trade", tools::add_scan_trade_options, terrain, radar, arguments);
}

void add_offline_runs(py::module_& module) {
  py::reinterpret_borrow<py::class_<Terrain, std::shared_ptr<Terrain>>>(module.attr("Terrain"))
      .def_static("generate", &generate_terrain, py::arg("directory"), R"(Writes a made-up landscape as DTED cells.

As `yars terrain generate`: options south, west [deg], cells_lat, cells_lon, level 0 to 2, seed, edge ("coast" or "cut"),
culture (False: none), airfields ("paved" or "soil"), sea, threads. Returns the directory.
Errors: ValueError for options, yars.Error for files that cannot be written.)");
  py::reinterpret_borrow<py::class_<Scene, std::shared_ptr<Scene>>>(module.attr("Scene"))
      .def_static("generate", &generate_scene, py::arg("path"), R"(Writes a made-up scene as an OpenFlight file.

As `yars scene generate`: kind ("airfield", "harbour", "bridge" or "town"), triangles (about as many), seed,
origin=(latitude, longitude) or (latitude, longitude, heading) [deg]. Returns the path.
Errors: ValueError for options, yars.Error for a file that cannot be written.)");
  module.def("trade", &trade, py::arg("maps"), py::arg("terrain").none(true), py::arg("radar"));
}

}  // namespace yars::python
