#include "lib/radar/windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace yars::radar {

namespace {

struct WindowRow {
  double window_nm;    // [NM] side of the square
  double least_nm;     // [NM] cursor range
  double greatest_nm;  // [NM]
};
constexpr std::array<WindowRow, 8> kWindows{{{0.67, 4.7, 20.0},
                                             {1.3, 4.7, 40.0},
                                             {3.3, 4.7, 50.0},
                                             {4.7, 4.7, 80.0},
                                             {10.0, 10.0, 160.0},
                                             {20.0, 20.0, 160.0},
                                             {40.0, 40.0, 160.0},
                                             {80.0, 80.0, 160.0}}};

// [NM] Two sizes closer than this are one: the sizes are given to 0.01 NM, and they pass through metres.
constexpr double kSameWindow_nm = 0.005;

}  // namespace

std::optional<CursorLimits> cursor_limits(geo::Length window) {
  const auto row = std::find_if(kWindows.begin(), kWindows.end(), [window](const WindowRow& candidate) {
    return std::abs(candidate.window_nm - window.nautical_miles()) < kSameWindow_nm;
  });
  if (row == kWindows.end()) return std::nullopt;
  return CursorLimits{geo::Length::nautical_miles(row->least_nm), geo::Length::nautical_miles(row->greatest_nm)};
}

std::optional<std::size_t> largest_window_that_fits(geo::Length range, std::span<const double> windows_nm) {
  const auto beyond = std::find_if(windows_nm.begin(), windows_nm.end(), [range](double window_nm) {
    return geo::Length::nautical_miles(window_nm) > range;
  });
  if (beyond == windows_nm.begin()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(windows_nm.begin(), beyond)) - 1;
}

std::optional<geo::Length> window_while_blank(geo::Length cursor_range) {
  if (!(cursor_range >= geo::Length::nautical_miles(2.7))) return std::nullopt;
  if (cursor_range <= geo::Length::nautical_miles(50.0)) return geo::Length::nautical_miles(3.3);
  if (cursor_range <= geo::Length::nautical_miles(80.0)) return geo::Length::nautical_miles(4.7);
  if (cursor_range <= geo::Length::nautical_miles(150.0)) return geo::Length::nautical_miles(10.0);
  return std::nullopt;
}

}  // namespace yars::radar
