// Class Radar of the Python module: yars::Radar, with requests from keyword arguments and results as NumPy arrays.
// Functions of the module that write files or measure: made-up scenes and terrain, trades.
// Inputs: settings; requests, whose fields Python sets by name; names of files.
// Outputs: ScanResult, PatchResult, many maps at once; files; the JSON text of a trade. Progress goes to a terminal
// alone. Errors: ValueError and yars.Error with the fields of the library's error.
// Threads: the interpreter's lock is released while files are read and while pictures are computed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python/core/patch_series.hpp"
#include "python/core/places.hpp"
#include "python/core/results.hpp"
#include "python/core/support.hpp"
#include "yars/radar.hpp"

namespace yars::python {

class Radar {
 public:
  explicit Radar(const RadarSettings& settings);

  std::shared_ptr<ScanResult> scan(const std::shared_ptr<Terrain>& terrain, const std::shared_ptr<Scene>& scene,
                                   const ScanRequest& request) const;
  std::shared_ptr<PatchResult> patch(const std::shared_ptr<Terrain>& terrain, const std::shared_ptr<Scene>& scene,
                                     const PatchRequest& request) const;
  // Many maps in one call (patch_series.hpp).
  py::dict patches(const std::shared_ptr<Terrain>& terrain, const py::array& orders, std::shared_ptr<Scene> scene,
                   const py::object& movers, const std::vector<std::string>& arrays, int threads, bool force,
                   int min_pixels) const;

  const yars::Radar& radar() const { return *radar_; }

 private:
  std::unique_ptr<yars::Radar> radar_;
  std::unique_ptr<PatchPool> pool_ = std::make_unique<PatchPool>();
};

void add_radar(py::module_& module);

// Adds generate_terrain(), generate_scene() and trade().
void add_offline_runs(py::module_& module);

}  // namespace yars::python
