#include "python/core/radar_class.hpp"

#include <pybind11/stl.h>

#include <cctype>
#include <functional>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "lib/file/file_search.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "tools/command/command.hpp"
#include "tools/patch/patch_setup.hpp"
#include "tools/scan/scan_setup.hpp"

namespace yars::python {

namespace {

namespace hrm = model::hrm;

// Slot of the form Fidelity for a knob's name: mapSize for map_size.
std::string slot_of(const std::string& knob) {
  std::string slot;
  bool upper = false;
  for (const char letter : knob) {
    if (letter != '_') slot += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
    upper = letter == '_';
  }
  return slot;
}

// Value of a slot as GUF. Throws ValueError for a value that is neither number, truth value nor name.
std::string guf_of(const std::string& knob, const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return py::cast<bool>(value) ? "true" : "false";
  if (PyLong_Check(value.ptr())) return py::str(value);
  if (PyUnicode_Check(value.ptr())) {
    auto text = py::cast<std::string>(value);
    const auto is_plain = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  } else if (PyFloat_Check(value.ptr())) {
    return py::repr(value);
  }
  raise_value_error("yars.Radar: " + knob + ": expected a number, True, False or a name, found " +
                    py::cast<std::string>(py::repr(value)));
}

std::string fidelity_form(const py::object& preset, const py::dict& knobs) {
  std::string form = "( Fidelity";
  if (!preset.is_none()) form += " :preset " + guf_of("preset", preset);
  for (const auto& [knob, value] : knobs)
    form += " :" + slot_of(py::cast<std::string>(knob)) + ' ' + guf_of(py::cast<std::string>(knob), value);
  return form + " )\n";
}

// Loads GUF text. A warning about text that Python gave is an error: it says that a part has no effect.
radar::RadarConfiguration load(const std::string& text, const std::string& name, std::vector<std::string>& warnings) {
  auto loaded = config::load_configuration_text(text, name);
  if (!loaded) raise(error::usage_error(loaded.error()));
  warnings = std::move(loaded->warnings);
  return std::move(loaded->radar);
}

}  // namespace

Radar::Radar(const py::object& preset, const std::optional<std::string>& config, const std::string& settings,
             const py::dict& knobs) {
  const std::string form = fidelity_form(preset, knobs);
  for (const auto& [text, name] : {std::pair{form, "yars.Radar"}, std::pair{settings, "yars.Radar settings"}}) {
    std::vector<std::string> faults;
    load(text, name, faults);
    if (!faults.empty()) raise_value_error(faults.front());
  }
  std::string text;
  Warnings warnings;
  if (config) {
    auto converted = config::convert_configuration(*config, {});
    if (!converted) raise(converted.error());
    for (const std::string& warning : converted->warnings) warnings.sink()(warning);
    text = converted->text;
  }
  std::vector<std::string> of_the_file;  // already shown
  configuration_ = load(text + '\n' + settings + '\n' + form, "yars.Radar", of_the_file);
  warnings.show("yars.Radar", 3);
}

std::shared_ptr<ScanResult> Radar::scan(const std::shared_ptr<Terrain>& terrain, std::shared_ptr<Scene> scene,
                                        const std::vector<std::string>& words) const {
  tools::ScanOptions options;
  read_options("yars.Radar.scan", words,
               [&](databuffer::Command command) { tools::add_scan_options(command, options); });
  radar::RadarConfiguration configuration = configuration_;
  tools::configure_scan(options, configuration);
  configuration.terrain = terrain->configuration();
  check_same_terrain(scene.get(), *terrain);
  if (scene) configuration.world.scenes = scene->scenes();
  const model::kernel::ScanRequest request = tools::request_of(options);
  check_arguments([&] { tools::check_scan(options, configuration); });
  Warnings warnings;
  std::unique_ptr<ScanResult::Parts> scan;  // without its threads
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    auto environment = terrain->with_theatre(
        configuration.world.scenes, model::scene::SceneUse::scatterers, warnings, goes_on,
        [&](tools::Theatre& theatre) { return theatre.prepare(request, configuration.fidelity, warnings.sink()); });
    check_arguments([&] { tools::check_scan_height(options, *environment.terrain); });
    model::kernel::OfflineScan work(configuration, request, options.threads);
    work.run({*environment.terrain, environment.scene.get()}, goes_on);
    scan = std::make_unique<ScanResult::Parts>(ScanResult::Parts{work.take_result(), std::move(environment)});
  });
  warnings.show("yars.Radar.scan");
  return std::make_shared<ScanResult>(configuration, std::move(*scan), std::move(scene));
}

std::shared_ptr<PatchResult> Radar::patch(const std::shared_ptr<Terrain>& terrain, const std::shared_ptr<Scene>& scene,
                                          const std::vector<std::string>& words) const {
  tools::PatchOptions options;
  read_options("yars.Radar.patch", words,
               [&](databuffer::Command command) { tools::add_patch_options(command, options); });
  radar::RadarConfiguration configuration = configuration_;
  check_arguments([&] { tools::configure_patch(options, configuration); });
  configuration.terrain = terrain->configuration();
  check_same_terrain(scene.get(), *terrain);
  if (scene) configuration.world.scenes = scene->scenes();
  const hrm::PatchOrder order = tools::order_of(options, configuration);
  check_arguments([&] { tools::check_order(order, configuration, options.force); });
  Warnings warnings;
  std::unique_ptr<PatchResult::Parts> map;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    parallel::ThreadPool workers(tools::threads_of(options));
    hrm::PatchFormation formation(
        configuration,
        {workers.threads(), [&workers](const std::function<void(std::size_t)>& job) { workers.run(job); }},
        hrm::kMaxSectorPoints, hrm::LabelUse::heights);
    const hrm::PatchNeed need = formation.begin(order);
    const hrm::PatchEnvironment environment =
        terrain->with_theatre(configuration.world.scenes, model::scene::SceneUse::triangles, warnings, goes_on,
                              [&](tools::Theatre& theatre) { return theatre.prepare(need, warnings.sink()); });
    if (!options.force) check_arguments([&] { tools::check_heights(order, environment, configuration); });
    formation.set_environment(environment);
    for (; formation.state() != hrm::PatchState::done; formation.advance()) parallel::check(goes_on);
    map = std::make_unique<PatchResult::Parts>(PatchResult::parts_of(formation));
  });
  warnings.show("yars.Radar.patch");
  return std::make_shared<PatchResult>(std::move(*map), order, configuration.fidelity.name);
}

py::dict Radar::patches(const std::shared_ptr<Terrain>& terrain, const py::array& orders, std::shared_ptr<Scene> scene,
                        const py::object& movers, const std::vector<std::string>& arrays, int threads, bool force,
                        int min_pixels) const {
  check_same_terrain(scene.get(), *terrain);
  return patch_series(configuration_, *pool_,
                      {terrain, std::move(scene), orders, movers, arrays, threads, force, min_pixels});
}

std::string Radar::text() const {
  return config::print_configuration(configuration_);
}

void add_radar(py::module_& module) {
  module.def(
      "installed_file", [](const std::string& name) { return py::bytes(file::installed_file(name)); }, py::arg("name"),
      "Path of a file that came with YARS and is named without a folder; any other path as it is given.");
  py::class_<Radar> type(module, "Radar");
  type.def("scan", &Radar::scan, py::arg("terrain").none(false), py::arg("scene").none(true), py::arg("words"))
      .def("patch", &Radar::patch, py::arg("terrain").none(false), py::arg("scene").none(true), py::arg("words"))
      .def("patches", &Radar::patches, py::arg("terrain").none(false), py::arg("orders"), py::arg("scene").none(true),
           py::arg("movers"), py::arg("arrays"), py::arg("threads"), py::arg("force"), py::arg("min_pixels"))
      .def_property_readonly("guf", &Radar::text)
      .def_property_readonly("name", [](const Radar& radar) { return radar.configuration().name; })
      .def_property_readonly("fidelity", [](const Radar& radar) { return radar.configuration().fidelity.name; })
      .def_property_readonly("map_size", [](const Radar& radar) { return radar.configuration().fidelity.map_size; })
      .def_property_readonly("samples", [](const Radar& radar) { return radar.configuration().fidelity.samples; });
  seal(type);
  module.def(
      "make_radar",
      [](const py::object& preset, const std::optional<std::string>& config, const std::string& settings,
         const py::dict& knobs) { return std::make_unique<Radar>(preset, config, settings, knobs); },
      py::arg("preset"), py::arg("config"), py::arg("settings"), py::arg("knobs"));
}

}  // namespace yars::python
