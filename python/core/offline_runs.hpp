// Functions of the Python module that write files or measure: made-up scenes and terrain, trades.
// Inputs: keyword arguments that are the options of `yars scene generate`, `yars terrain generate`, `yars trade` and
// `yars trade maps`. Outputs: paths; the JSON text of a trade.
// Errors: ValueError and yars.Error with the messages of the commands. Progress goes to a terminal alone.
#pragma once

#include <memory>
#include <string>

#include "python/core/places.hpp"
#include "python/core/radar_class.hpp"
#include "python/core/support.hpp"

namespace yars::python {

// Returns the path.
std::string generate_scene(const py::object& path, const py::kwargs& arguments);
// Returns the folder.
std::string generate_terrain(const py::object& directory, const py::kwargs& arguments);
// JSON that `yars trade --out` writes. Null terrain: that of the radar's configuration, else the built-in hills.
std::string trade(bool maps, const std::shared_ptr<Terrain>& terrain, const Radar& radar, const py::kwargs& arguments);

// Adds trade(), and generate() of the classes Terrain and Scene. Call it after add_places().
void add_offline_runs(py::module_& module);

}  // namespace yars::python
