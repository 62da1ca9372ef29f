// Display windows of patch maps: which fit the selected range, where the cursor may be for each, and which one a
// blank window stands for. Source: docs/spec/pilots_interface.md#rule-4 (tables 1 to 3 of the report), by the tables of
// the configuration.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::radar {

// Least and greatest cursor range at which a window can be mapped; both ends belong to it.
struct CursorLimits {
  geo::Length least;
  geo::Length greatest;
  bool contains(geo::Length range) const { return least <= range && range <= greatest; }
};

// Limits of a window; nothing for a size that the table does not name.
std::optional<CursorLimits> cursor_limits(geo::Length window, const WindowLimits& table);

// Index of the largest window [NM] that is not larger than the range; nothing when all are. `windows_nm` ascends.
std::optional<std::size_t> largest_window_that_fits(geo::Length range, std::span<const double> windows_nm);

// The window that a map takes while the selection is blank, by the cursor's range; nothing: the command is rejected.
std::optional<geo::Length> window_while_blank(geo::Length cursor_range, const WindowLimits& table);

}  // namespace yars::radar
