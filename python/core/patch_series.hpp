// Many patch maps in one call: an array of orders gives arrays of pictures and labels, one entry for each order.
// Inputs: structured arrays PATCH_ORDER and MOVER. Outputs: a dict of arrays; geometry and boxes as structured arrays.
// Units: as the suffix of each name says. Others are degrees, feet, knots and nautical miles, as the options have them.
// Errors: ValueError names the index of the order that is beyond the radar's limits.
// Source: docs/python.md, "Many maps".
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "python/core/calls.hpp"
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
  int min_pixels = 0;  // boxes of objects with fewer labelled pixels are left out
};

// A patch formation with its threads. The configuration must not move, because the formation refers to it.
struct Formation {
  Formation(const radar::RadarConfiguration& configuration, std::size_t threads, model::hrm::LabelUse labels);
  radar::RadarConfiguration configuration;
  model::hrm::LabelUse use;
  parallel::ThreadPool workers;
  model::hrm::PatchFormation patch_formation;
};

// Formations of one configuration that no call uses. A new one costs as much as some ten small maps.
// A child of fork() has no threads of its parent; it makes formations of its own.
class FormationPool {
 public:
  ~FormationPool() { forget_those_of_the_parent(); }
  std::unique_ptr<Formation> take(const radar::RadarConfiguration& configuration, std::size_t threads,
                                  model::hrm::LabelUse labels);
  void give_back(std::unique_ptr<Formation> formation);

 private:
  void forget_those_of_the_parent();

  std::mutex mutex_;
  std::vector<std::unique_ptr<Formation>> free_;
  int process_ = 0;  // that has made the formations
};

py::dict patch_series(const radar::RadarConfiguration& configuration, FormationPool& pool,
                      const SeriesRequest& request);

// Adds PATCH_ORDER and MOVER.
void add_series(py::module_& module);

}  // namespace yars::python
