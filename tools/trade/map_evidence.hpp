// What one fidelity makes of one map, and how far that is from the ruler. Everything without noise, speckle and the
// random numbers of 1996: they are no error, and the ruler draws others. A comparison goes over the ruler's pixels:
// each takes the pixel that its middle lies in.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_process.hpp"

namespace yars::tools::trade {

struct MapEvidence {
  int size = 0;                                            // [pixels] on an edge
  std::vector<float> power;                                // gamma of level ground; of 1996: brightness
  std::vector<std::uint8_t> dark;                          // 1: returns less than a twentieth of level ground
  std::vector<std::uint8_t> video;                         // as drawn
  std::vector<std::optional<model::hrm::MapPoint>> marks;  // where those of mark_scene.hpp appear; none: hidden
  bool power_is_radar = true;                              // false: brightness of 1996
  double noise = 0.0;                                      // thermal noise, as gamma of level ground
  double took_ms = 0.0;                                    // [ms] of the thread's processor time, by the clock given
};

// Processor time of the thread [ms]; the caller has the clock.
using Clock = double (*)();

MapEvidence observe_map(const radar::RadarConfiguration& configuration, const model::hrm::PatchOrder& order,
                        const model::hrm::PatchDatabase& database, Clock clock);

// One map from the order to its video, noise as configured; [ms].
double time_map(model::hrm::PatchProcess& process, const model::hrm::PatchOrder& order,
                const model::hrm::PatchDatabase& database, Clock clock);

struct MapErrors {
  double position_m = 0.0;      // [m] farthest that a mark lies from the ruler's; NaN: the ruler sees none
  double shadow_percent = 0.0;  // [%] of the pixels that one has dark and the other has not
  double power_db = 0.0;        // [dB] RMS where neither is dark and the ruler's stands above the noise; NaN: nowhere
  double gray_levels = 0.0;     // RMS of the video, of 255
};

MapErrors errors_against(const MapEvidence& ruler, const MapEvidence& found);

}  // namespace yars::tools::trade
