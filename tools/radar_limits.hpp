// The radar's limits as `yars patch` and `yars scan` tell of them: which one is broken, by what numbers, and what to
// do. The limits themselves are those of the radar: lib/radar/mappable.hpp and the gimbal.
#pragma once

#include <optional>

#include "lib/failure/error.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"

namespace yars::tools {

// Nothing: within them, in all that follows. A map's blind zone, gimbal in azimuth, windows and their ranges, before
// terrain is read.
std::optional<failure::Error> beyond_limits(const model::hrm::PatchOrder& order,
                                            const radar::RadarConfiguration& configuration);

// The aircraft's height against the ground [m] MSL at the map's middle: the gimbal in elevation. NaN: not known.
std::optional<failure::Error> beyond_depression(const model::hrm::PatchOrder& order, double target_ground_m,
                                                const radar::RadarConfiguration& configuration);

// A scan about the nose.
std::optional<failure::Error> beyond_gimbal(geo::Angle elevation, geo::Angle width,
                                            const radar::AntennaConfiguration& antenna);

// An aircraft in the ground sees nothing. NaN: not known.
std::optional<failure::Error> beneath_ground(geo::AltitudeMsl altitude, double ground_m);

}  // namespace yars::tools
