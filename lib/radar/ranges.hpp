// Which range the radar takes by itself: low over ground a short one, high up a long one.
// Source: docs/spec/pilots_interface.md#rule-1, by the table of the configuration (a height belongs to the lower
// range).
#pragma once

#include <cstddef>
#include <span>

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::radar {

// The range for a height over ground or sea. A NaN height counts as high.
geo::Length range_by_height(geo::Length height, const HeightRanges& table);

// Index of the shortest range [NM] that is not below the wanted one; of the last where all are shorter.
// `ranges_nm` ascends and is not empty.
std::size_t range_index_for(geo::Length wanted, std::span<const double> ranges_nm);

}  // namespace yars::radar
