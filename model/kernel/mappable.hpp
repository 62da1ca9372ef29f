// Whether a patch map could be commanded at the cursor, and if not, what the glass says.
// Source: spec pvi.md rules 2 to 5.
#pragma once

#include <optional>
#include <string_view>

#include "lib/radar/configuration.hpp"
#include "model/antenna/stabilization.hpp"

namespace yars::model::kernel {

// Nothing: mappable. `window` of zero is the blank one. Either point may not be finite: then "NO CURSOR".
std::optional<std::string_view> why_not_mappable(const antenna::Platform& platform, geo::GeoPoint aircraft,
                                                 geo::GeoPoint cursor, geo::Length window,
                                                 const radar::RadarConfiguration& configuration);

}  // namespace yars::model::kernel
