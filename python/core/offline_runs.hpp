// Functions of the Python module that write files or measure: made-up scenes and terrain, trades.
// Inputs: words that are the options of `yars scene generate`, `yars terrain generate`, `yars trade` and
// `yars trade maps`. Outputs: files; the JSON text of a trade.
// Errors: ValueError and yars.Error with the messages of the commands. Progress goes to a terminal alone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python/core/places.hpp"
#include "python/core/radar_class.hpp"
#include "python/core/support.hpp"

namespace yars::python {

void generate_scene(const std::vector<std::string>& words);
void generate_terrain(const std::vector<std::string>& words);
// JSON that `yars trade --out` writes. Null terrain: that of the radar's configuration, else the built-in hills.
std::string trade(bool maps, const std::shared_ptr<Terrain>& terrain, const Radar& radar,
                  const std::vector<std::string>& words);

// Adds these functions.
void add_offline_runs(py::module_& module);

}  // namespace yars::python
