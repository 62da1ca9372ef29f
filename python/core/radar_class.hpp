// Class Radar of the Python module: a configuration, and the scans and maps that it gives over a terrain.
// Inputs: preset, configuration file, GUF text, settings of the form Fidelity; arguments as words of `yars scan` and
// `yars patch`. Outputs: ScanResult, PatchResult, many maps at once.
// Errors: ValueError and yars.Error with the messages of the commands.
// Threads: the interpreter's lock is released while files are read and while pictures are computed.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "python/core/patch_series.hpp"
#include "python/core/places.hpp"
#include "python/core/results.hpp"
#include "python/core/support.hpp"

namespace yars::python {

class Radar {
 public:
  // `preset`: None: that of the file, else standard. `config`: a GUF file; nullopt: built-in defaults. `settings`: GUF
  // text with forms that replace those of the file. `knobs`: slots of the form Fidelity, map_size for mapSize; their
  // values are numbers, truth values and texts.
  Radar(const py::object& preset, const std::optional<std::string>& config, const std::string& settings,
        const py::dict& knobs);

  std::shared_ptr<ScanResult> scan(const std::shared_ptr<Terrain>& terrain, std::shared_ptr<Scene> scene,
                                   const std::vector<std::string>& words) const;
  std::shared_ptr<PatchResult> patch(const std::shared_ptr<Terrain>& terrain, const std::shared_ptr<Scene>& scene,
                                     const std::vector<std::string>& words) const;
  // Many maps, as patch_series.hpp says.
  py::dict patches(const std::shared_ptr<Terrain>& terrain, const py::array& orders, std::shared_ptr<Scene> scene,
                   const py::object& movers, const std::vector<std::string>& arrays, int threads, bool force,
                   int min_pixels) const;

  const radar::RadarConfiguration& configuration() const { return configuration_; }
  std::string text() const;  // the configuration as GUF

 private:
  radar::RadarConfiguration configuration_;
  std::unique_ptr<FormationPool> pool_ = std::make_unique<FormationPool>();
};

void add_radar(py::module_& module);

}  // namespace yars::python
