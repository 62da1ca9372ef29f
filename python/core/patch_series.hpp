// Many patch maps in one call: an array of orders gives arrays of pictures and labels, one entry for each order.
// Inputs: structured arrays PATCH_ORDER and MOVER. Outputs: a dict of arrays; geometry and boxes as structured arrays.
// Units: as the suffix of each name says; degrees, and feet, knots and nautical miles, as in the options of `yars
// patch`. Errors: ValueError names the index of the order that is beyond the radar's limits. Source: docs/python.md,
// "Many maps".
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "python/core/places.hpp"
#include "python/core/support.hpp"

namespace yars::python {

struct SeriesRequest {
  std::shared_ptr<Terrain> terrain;
  std::shared_ptr<Scene> scene;  // null: the scenes in the terrain's folder, and those of the configuration
  py::array orders;
  py::object movers;  // None: none but those of the configuration
  std::vector<std::string> arrays;
  int threads = 1;
  bool force = false;
};

py::dict patch_series(const radar::RadarConfiguration& configuration, const SeriesRequest& request);

// Adds PATCH_ORDER, MOVER, and xxh3().
void add_series(py::module_& module);

}  // namespace yars::python
