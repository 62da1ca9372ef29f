#include "lib/radar/windows.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace yars::radar {

namespace {
// [NM] Two sizes closer than this are one: the sizes are given to 0.01 NM, and they pass through metres.
constexpr double kSameWindow_nm = 0.005;
}  // namespace

std::optional<CursorLimits> cursor_limits(geo::Length window, const WindowLimits& table) {
  const auto found = std::find_if(table.windows_nm.begin(), table.windows_nm.end(), [window](double candidate_nm) {
    return std::abs(candidate_nm - window.nautical_miles()) < kSameWindow_nm;
  });
  const auto row = static_cast<std::size_t>(found - table.windows_nm.begin());
  if (row >= table.windows_nm.size() || row >= table.least_nm.size() || row >= table.greatest_nm.size()) return {};
  return CursorLimits{geo::Length::nautical_miles(table.least_nm[row]),
                      geo::Length::nautical_miles(table.greatest_nm[row])};
}

std::optional<std::size_t> largest_window_that_fits(geo::Length range, std::span<const double> windows_nm) {
  const auto beyond = std::find_if(windows_nm.begin(), windows_nm.end(), [range](double window_nm) {
    return geo::Length::nautical_miles(window_nm) > range;
  });
  if (beyond == windows_nm.begin()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(windows_nm.begin(), beyond)) - 1;
}

std::optional<geo::Length> window_while_blank(geo::Length cursor_range, const WindowLimits& table) {
  if (!(cursor_range >= geo::Length::nautical_miles(table.blank_least_nm))) return std::nullopt;
  const std::size_t rows = std::min(table.blank_windows_nm.size(), table.blank_up_to_nm.size());
  for (std::size_t row = 0; row < rows; ++row) {
    if (cursor_range <= geo::Length::nautical_miles(table.blank_up_to_nm[row]))
      return geo::Length::nautical_miles(table.blank_windows_nm[row]);
  }
  return std::nullopt;
}

}  // namespace yars::radar
