// Many patch maps in one call: an array of orders gives arrays of pictures and labels, one entry for each order.
// Inputs: structured arrays PATCH_ORDER and MOVER. Outputs: a dict of arrays; geometry and boxes as structured arrays.
// Units: as the suffix of each name says; positions and headings in degrees, corners in pixels.
// Errors: ValueError names the index of the order that is beyond the radar's limits.
// Source: docs/python.md, "Many maps".
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "python/core/calls.hpp"
#include "python/core/places.hpp"
#include "python/core/support.hpp"
#include "yars/radar.hpp"

namespace yars::python {

struct SeriesRequest {
  std::shared_ptr<Terrain> terrain;
  std::shared_ptr<Scene> scene;  // null: the scenes in the terrain's folder, and those of the configuration
  py::array orders;
  py::object movers;  // None: only those of the configuration
  std::vector<std::string> arrays;
  int threads = 1;
  bool force = false;
  int min_pixels = 0;  // boxes of objects with fewer labelled pixels are left out
};

// Patch objects of one radar that no call uses at present, kept with their threads and memory. Making a Patch takes as
// long as about ten small maps. A child of fork() does not have its parent's threads, so it makes Patches of its own.
class PatchPool {
 public:
  ~PatchPool() { forget_those_of_the_parent(); }
  // A Patch with these threads and labels; nullptr: none is free.
  std::unique_ptr<Patch> take(std::size_t threads, LabelUse labels);
  void give_back(std::unique_ptr<Patch> patch, LabelUse labels);

 private:
  void forget_those_of_the_parent();

  struct Free {
    std::unique_ptr<Patch> patch;
    LabelUse labels;
  };
  std::mutex mutex_;
  std::vector<Free> free_;
  int process_ = 0;  // pid of the process that made the Patches
};

py::dict patch_series(const yars::Radar& radar, PatchPool& pool, const SeriesRequest& request);

// Adds PATCH_ORDER and MOVER.
void add_series(py::module_& module);

}  // namespace yars::python
