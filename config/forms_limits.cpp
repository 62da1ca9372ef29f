#include <algorithm>
#include <cstddef>

#include "config/field.hpp"
#include "config/forms.hpp"
#include "config/value.hpp"
#include "lib/radar/windows.hpp"

namespace yars::config {
namespace {

std::string count_text(std::size_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what);
}

std::optional<Complaint> check_limits(const Draft& draft) {
  const radar::WindowLimits& table = draft.radar.window_limits;
  const std::size_t windows = table.windows_nm.size();
  for (const auto& [slot, limits] : {std::pair{"least", &table.least_nm}, std::pair{"greatest", &table.greatest_nm}}) {
    if (limits->size() != windows)
      return Complaint{slot, count_text(windows, "numbers, one a window of :windows"), std::to_string(limits->size())};
  }
  for (std::size_t i = 0; i < windows; ++i) {
    if (table.least_nm[i] < table.greatest_nm[i]) continue;
    return Complaint{"greatest",
                     "more than the least range of the window " + number_text(table.windows_nm[i]) + ", " +
                         number_text(table.least_nm[i]) + " NM",
                     number_text(table.greatest_nm[i])};
  }
  const std::size_t blank = table.blank_windows_nm.size();
  if (table.blank_up_to_nm.size() != blank) {
    return Complaint{"blankUpTo", count_text(blank, "numbers, one a window of :blankWindows"),
                     std::to_string(table.blank_up_to_nm.size())};
  }
  for (const double window_nm : table.blank_windows_nm) {
    if (radar::cursor_limits(geo::Length::nautical_miles(window_nm), table)) continue;
    return Complaint{"blankWindows", "windows of :windows", number_text(window_nm)};
  }
  return std::nullopt;
}

std::optional<Complaint> check_heights(const Draft& draft) {
  const radar::HeightRanges& table = draft.radar.height_ranges;
  const std::size_t wanted = table.heights_ft.size() + 1;
  if (table.ranges_nm.size() == wanted) return std::nullopt;
  return Complaint{"ranges", count_text(wanted, "numbers, one more than :heights"),
                   std::to_string(table.ranges_nm.size())};
}

SlotSchema miles(std::string_view name, double lowest, ListSlot binding, std::string_view purpose) {
  return {
      .name = name, .unit = "NM", .lowest = lowest, .highest = 1000, .binding = std::move(binding), .purpose = purpose};
}

FormSchema window_limits() {
  return {.name = "WindowLimits",
          .purpose = "where the cursor may be for each display window",
          .slots = {miles("windows", 0.1, {YARS_FIELD(radar.window_limits.windows_nm), 1, 16, Order::ascending},
                          "display windows; at least those of SarMode"),
                    miles("least", 0, {YARS_FIELD(radar.window_limits.least_nm), 1, 16},
                          "least cursor range, a number a window"),
                    miles("greatest", 0.1, {YARS_FIELD(radar.window_limits.greatest_nm), 1, 16},
                          "greatest cursor range, a number a window"),
                    number_slot("blankLeast", "NM", 0, 1000, {YARS_FIELD(radar.window_limits.blank_least_nm)},
                                "nearer than this a map without a window is rejected"),
                    miles("blankWindows", 0.1, {YARS_FIELD(radar.window_limits.blank_windows_nm), 1, 16},
                          "windows that a map without one takes, by cursor range"),
                    miles("blankUpTo", 0.1, {YARS_FIELD(radar.window_limits.blank_up_to_nm), 1, 16, Order::ascending},
                          "greatest cursor range of each of them; beyond the last, rejected"),
                    number_slot("powerUp", "NM", 0.1, 1000, {YARS_FIELD(radar.window_limits.power_up_nm)},
                                "selected at power-up, or the largest window below")},
          .check = check_limits,
          .agree = check_windows_have_limits};
}

FormSchema height_ranges() {
  return {.name = "HeightRanges",
          .purpose = "the range that the radar takes by itself, at power-up and on a mode change",
          .slots = {{.name = "heights",
                     .unit = "ft",
                     .lowest = 0,
                     .highest = 100'000,
                     .binding = ListSlot{YARS_FIELD(radar.height_ranges.heights_ft), 1, 15, Order::ascending},
                     .purpose = "heights over ground or sea; each belongs to the range below"},
                    miles("ranges", 0.1, {YARS_FIELD(radar.height_ranges.ranges_nm), 2, 16, Order::ascending},
                          "up to each height, and above the last; the shortest range that is not below is taken")},
          .check = check_heights};
}

}  // namespace

std::optional<Complaint> check_windows_have_limits(const Draft& draft) {
  for (const double window_nm : draft.radar.windows_nm) {
    if (radar::cursor_limits(geo::Length::nautical_miles(window_nm), draft.radar.window_limits)) continue;
    return Complaint{"windows",
                     "every window of SarMode among the windows of WindowLimits, with a least and a greatest range",
                     "none for " + number_text(window_nm) + " NM"};
  }
  return std::nullopt;
}

std::vector<FormSchema> limit_forms() {
  return {window_limits(), height_ranges()};
}

}  // namespace yars::config
