#include "python/core/radar_class.hpp"

#include <pybind11/stl.h>

#include <cctype>
#include <functional>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
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
  if (PyIndex_Check(value.ptr())) return py::str(py::int_(py::reinterpret_borrow<py::object>(value)));
  if (PyUnicode_Check(value.ptr())) {
    auto text = py::cast<std::string>(value);
    const auto is_plain = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  } else if (py::hasattr(value, "__float__")) {
    return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
  }
  raise_value_error("yars.Radar: " + knob + ": expected a number, True, False or a name, found " +
                    py::cast<std::string>(py::repr(value)));
}

std::string fidelity_form(const py::object& preset, const py::kwargs& knobs) {
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

Radar::Radar(const py::object& preset, const py::object& config, const std::string& settings, const py::kwargs& knobs) {
  const std::string form = fidelity_form(preset, knobs);
  for (const auto& [text, name] : {std::pair{form, "yars.Radar"}, std::pair{settings, "yars.Radar settings"}}) {
    std::vector<std::string> faults;
    load(text, name, faults);
    if (!faults.empty()) raise_value_error(faults.front());
  }
  std::string text;
  Warnings warnings;
  if (!config.is_none()) {
    const auto path = py::cast<std::string>(py::module_::import("os").attr("fspath")(config));
    auto converted = config::convert_configuration(path, {});
    if (!converted) raise(converted.error());
    for (const std::string& warning : converted->warnings) warnings.sink()(warning);
    text = converted->text;
  }
  std::vector<std::string> of_the_file;  // already shown
  configuration_ = load(text + '\n' + settings + '\n' + form, "yars.Radar", of_the_file);
  warnings.show("yars.Radar");
}

std::shared_ptr<ScanResult> Radar::scan(const std::shared_ptr<Terrain>& terrain, std::shared_ptr<Scene> scene,
                                        const py::kwargs& arguments) const {
  tools::ScanOptions options;
  read_options("yars scan", arguments, [&](databuffer::Command command) { tools::add_scan_options(command, options); });
  radar::RadarConfiguration configuration = configuration_;
  tools::configure_scan(options, configuration);
  configuration.terrain = terrain->configuration();
  check_same_terrain(scene.get(), *terrain);
  if (scene) configuration.world.scenes = scene->scenes();
  const model::kernel::ScanRequest request = tools::request_of(options);
  check_arguments([&] { tools::check_scan(options, configuration); });
  Warnings warnings;
  std::shared_ptr<ScanResult> result;
  {
    const py::gil_scoped_release released;
    tools::ScanEnvironment environment;
    {
      const std::lock_guard guard(terrain->mutex());
      environment = terrain->theatre(configuration.world.scenes, model::scene::SceneUse::scatterers)
                        .prepare(request, configuration.fidelity, warnings.sink());
    }
    check_arguments([&] { tools::check_scan_height(options, *environment.terrain); });
    result =
        std::make_shared<ScanResult>(configuration, request, options.threads, std::move(environment), std::move(scene));
  }
  warnings.show("yars scan");
  return result;
}

std::shared_ptr<PatchResult> Radar::patch(const std::shared_ptr<Terrain>& terrain, const std::shared_ptr<Scene>& scene,
                                          const py::kwargs& arguments) const {
  tools::PatchOptions options;
  read_options("yars patch", arguments,
               [&](databuffer::Command command) { tools::add_patch_options(command, options); });
  radar::RadarConfiguration configuration = configuration_;
  check_arguments([&] { tools::configure_patch(options, configuration); });
  configuration.terrain = terrain->configuration();
  check_same_terrain(scene.get(), *terrain);
  if (scene) configuration.world.scenes = scene->scenes();
  const hrm::PatchOrder order = tools::order_of(options, configuration);
  check_arguments([&] { tools::check_order(order, configuration, options.force); });
  Warnings warnings;
  std::shared_ptr<PatchResult> result;
  {
    const py::gil_scoped_release released;
    parallel::ThreadPool workers(tools::threads_of(options));
    hrm::PatchFormation formation(
        configuration,
        {workers.threads(), [&workers](const std::function<void(std::size_t)>& job) { workers.run(job); }},
        hrm::kMaxSectorPoints, hrm::LabelUse::heights);
    const hrm::PatchNeed need = formation.begin(order);
    hrm::PatchEnvironment environment;
    {
      const std::lock_guard guard(terrain->mutex());
      environment = terrain->theatre(configuration.world.scenes, model::scene::SceneUse::triangles)
                        .prepare(need, warnings.sink());
    }
    if (!options.force) check_arguments([&] { tools::check_heights(order, environment, configuration); });
    formation.set_environment(environment);
    while (formation.state() != hrm::PatchState::done) formation.advance();
    result = std::make_shared<PatchResult>(formation, order, configuration.fidelity.name);
  }
  warnings.show("yars patch");
  return result;
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
  py::class_<Radar>(module, "Radar")
      .def(py::init<const py::object&, const py::object&, const std::string&, const py::kwargs&>(), py::arg("preset"),
           py::arg("config"), py::arg("settings"))
      .def("scan", &Radar::scan, py::arg("terrain").none(false), py::arg("scene").none(true))
      .def("patch", &Radar::patch, py::arg("terrain").none(false), py::arg("scene").none(true))
      .def("patches", &Radar::patches, py::arg("terrain").none(false), py::arg("orders"), py::arg("scene").none(true),
           py::arg("movers"), py::arg("arrays"), py::arg("threads"), py::arg("force"), py::arg("min_pixels"))
      .def_property_readonly("guf", &Radar::text)
      .def_property_readonly("name", [](const Radar& radar) { return radar.configuration().name; })
      .def_property_readonly("fidelity", [](const Radar& radar) { return radar.configuration().fidelity.name; })
      .def_property_readonly("map_size", [](const Radar& radar) { return radar.configuration().fidelity.map_size; })
      .def_property_readonly("samples", [](const Radar& radar) { return radar.configuration().fidelity.samples; });
}

}  // namespace yars::python
