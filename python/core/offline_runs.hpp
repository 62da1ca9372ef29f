// Functions of the Python module that write files or measure: made-up scenes and terrain, trades.
// Inputs: requests (radar_class.hpp), names of files. Outputs: files; the JSON text of a trade.
// Errors: ValueError and yars.Error with the fields of the library's error. Progress goes to a terminal alone.
#pragma once

#include "python/core/support.hpp"

namespace yars::python {

// Adds generate_terrain(), generate_scene() and trade().
void add_offline_runs(py::module_& module);

}  // namespace yars::python
