// The module yars._core: the kernels of scans and patch maps for Python. The package yars wraps it (results.py).

#include "python/core/calls.hpp"
#include "python/core/patch_series.hpp"
#include "python/core/places.hpp"
#include "python/core/radar_class.hpp"
#include "python/core/recording_class.hpp"
#include "python/core/results.hpp"
#include "python/core/support.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled part of the package yars.";
  yars::python::register_exceptions(module);
  yars::python::add_hashes(module);
  yars::python::add_calls(module);
  yars::python::add_places(module);
  yars::python::add_results(module);
  yars::python::add_radar(module);
  yars::python::add_series(module);
  yars::python::add_recording(module);
  yars::python::add_offline_runs(module);
}
