// A radar: a configuration, and the scans and patch maps that it gives over a terrain.
// Inputs: preset, configuration file, GUF text. Outputs: Scan, Patch.
// Errors: ErrorCode::argument and range for values of the caller, limit for what the radar cannot do, failed for files.
// Threads: a Radar is not changed after it was made.
// Accuracy: pictures are bit for bit those of `yars scan`, `yars patch` and the live radar.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "yars/call.hpp"
#include "yars/error.hpp"
#include "yars/patch.hpp"
#include "yars/requests.hpp"
#include "yars/scan.hpp"
#include "yars/scene.hpp"
#include "yars/terrain.hpp"

namespace yars {

namespace radar {
struct RadarConfiguration;
}

// A slot of the form Fidelity (docs/configuration/fidelity.md), such as {"samples", 480.0} or {"mapLayover", false}.
struct Knob {
  std::string name;
  std::variant<bool, double, std::string> value;
};

struct RadarSettings {
  std::string preset{};       // 1996, draft, standard, fine or reference; empty: that of the file, else standard
  std::string config_file{};  // GUF; empty: the built-in APG-70
  std::string guf{};          // forms that go before those of the file, such as "( Sea :state 3 )"
  std::vector<Knob> knobs{};  // go before the preset's
};

// Limits of the radar for patch maps, which PatchRequest::force ignores.
struct MapWindow {
  double window_nm = 0.0;                    // side of the map
  double least_nm = 0.0, greatest_nm = 0.0;  // ground range of the map's centre
};
struct RadarLimits {
  double blind_zone_deg = 0.0;                    // either side of the ground track, ahead and astern
  double azimuth_deg = 0.0, elevation_deg = 0.0;  // of the gimbal, either side of the nose, up and down
  std::vector<MapWindow> windows;                 // ascending
  double power_up_nm = 0.0;                       // window at power-up
  int looks = 0;                                  // of ML1
};

class YARS_EXPORT Radar {
 public:
  static Expected<Radar> make(const RadarSettings& settings = {}, const Call& call = {});

  const std::string& name() const;    // in its configuration
  const std::string& preset() const;  // "standard"; a changed preset has a name of its own
  int samples() const;                // of a sweep
  int map_size() const;               // pixels on an edge of a patch map
  std::string guf() const;            // the whole configuration
  RadarLimits limits() const;
  Expected<Terrain> terrain() const;  // of its configuration

  // One scan of the real beam map. `scene`: on the same terrain; null: the scenes in the terrain's folder, and those of
  // the configuration.
  Expected<Scan> scan(const Terrain& terrain, const ScanRequest& request, const Scene* scene = nullptr,
                      const Call& call = {}) const;
  // One patch map, with all labels.
  Expected<Patch> patch(const Terrain& terrain, const PatchRequest& request, const Scene* scene = nullptr,
                        const Call& call = {}) const;

  const radar::RadarConfiguration& configuration() const { return *configuration_; }  // used by the library
  explicit Radar(radar::RadarConfiguration configuration);

 private:
  std::shared_ptr<const radar::RadarConfiguration> configuration_;
};

}  // namespace yars
