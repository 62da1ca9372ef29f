// Counts that shape records: changing one changes the layout version.
#pragma once

#include <cstdint>

namespace yars::radar {

inline constexpr int kMaxSamples = 4096;  // samples of a sweep
inline constexpr int kBezelButtons = 20;
inline constexpr int kMaxPointsDrawn = 8;  // five nearest, the selected one, two spare
inline constexpr std::int64_t kTickNanoseconds =
    5'000'000;  // [ns] of sim time; radar-model and state-machine step by it
inline constexpr double kTickSeconds = 0.005;

}  // namespace yars::radar
