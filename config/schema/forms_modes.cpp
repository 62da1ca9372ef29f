#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "config/guf/tree.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/mapping.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"

namespace yars::config {

namespace {

using Names = std::vector<std::string_view>;

std::vector<SlotSchema> mode_slots(const Names& displays, const Names& antennas, IntegerSlot samples) {
  return {{.name = "display",
           .binding = FormSlot{{"Display", "RbmDisplay", "SarDisplay", "MgDisplay"}, displays},
           .purpose = "what the mode shows"},
          {.name = "antenna",
           .binding = FormSlot{{"RbmAntenna", "AntennaServo"}, antennas},
           .purpose = "how the mode scans"},
          {.name = "databases",
           .binding = FormSlot{{"Database", "DedDbase", "MgDbase", "Terrain"}, {}, true},
           .purpose = "terrain of the mode",
           .same_as = "terrain of Apg70"},
          {.name = "samples",
           .lowest = 1,
           .highest = 4096,
           .binding = samples,
           .purpose = "samples of a sweep",
           .same_as = samples.of != nullptr ? "samples of Fidelity" : ""}};
}

std::vector<SlotSchema> plain_mode_slots() {
  return mode_slots({}, {}, {});
}

FormSchema real_beam_mode() {
  return {.name = "RealBeamMode",
          .base = "Mode",
          .purpose = "real beam map",
          .slots = with_base(mode_slots({"RbmDisplay"}, {"RbmAntenna"}, {YARS_FIELD(radar.fidelity.samples)}),
                             {{.name = "sweepsPerDegree",
                               .unit = "1/deg",
                               .lowest = 0.01,
                               .highest = 100,
                               .binding = NumberSlot{},
                               .purpose = "sweeps of the 1996 scan; the tick and the rate of the dish settle it"},
                              {.name = "scanWidths",
                               .unit = "deg",
                               .lowest = 1,
                               .highest = 360,
                               .binding = ListSlot{YARS_FIELD(radar.scan_widths_deg), 3, 3, Order::descending},
                               .purpose = "FULL, HALF, QTR",
                               .same_as = "scanWidths of RbmAntenna"},
                              {.name = "ranges",
                               .unit = "NM",
                               .lowest = 0.1,
                               .highest = 500,
                               .binding = ListSlot{YARS_FIELD(radar.ranges_nm), 1, 16, Order::ascending},
                               .purpose = "ranges that can be selected",
                               .same_as = "ranges of Apg70"}})};
}

// Slot of an edge of a map. The 1996 report has separate slots for samples and sweep lines; maps are square.
SlotSchema map_edge(std::string_view name, IntegerSlot binding, std::string_view purpose) {
  return {.name = name,
          .lowest = 16,
          .highest = 1024,
          .binding = binding,
          .purpose = purpose,
          .same_as = "mapSize of Fidelity"};
}

void begin_sar_mode(ConfigurationBuilder& builder) {
  builder.map_samples = 0;
  builder.map_sweeps = 0;
}

std::optional<ConstraintViolation> check_sar_mode(const ConfigurationBuilder& builder) {
  if (builder.map_samples == 0 || builder.map_sweeps == 0 || builder.map_samples == builder.map_sweeps)
    return std::nullopt;
  return ConstraintViolation{"width", "the samples, " + std::to_string(builder.map_samples) + " (maps are square)",
                             std::to_string(builder.map_sweeps)};
}

void end_sar_mode(ConfigurationBuilder& builder) {
  const int given = std::max(builder.map_samples, builder.map_sweeps);
  if (given > 0) builder.radar.fidelity.map_size = given;
}

FormSchema sar_mode() {
  std::vector<SlotSchema> slots = mode_slots({}, {}, {});
  slots.back() = map_edge("samples", {YARS_FIELD(map_samples)}, "pixels of a map's edge");
  return {.name = "SarMode",
          .base = "Mode",
          .purpose = "high resolution map",
          .slots = with_base(std::move(slots),
                             {map_edge("width", {YARS_FIELD(map_sweeps)}, "sweep lines of a map, as many as samples"),
                              {.name = "patchSizes",
                               .unit = "m",
                               .lowest = 1,
                               .highest = 200'000,
                               .binding = ListSlot{nullptr, 1, 16},
                               .purpose = "patch sizes of 1996 by range; windows settle them"},
                              {.name = "windows",
                               .unit = "NM",
                               .lowest = 0.1,
                               .highest = 500,
                               .binding = ListSlot{YARS_FIELD(radar.windows_nm), 1, 16, Order::ascending},
                               .purpose = "display windows that can be selected; WindowLimits names each"}}),
          .begin = begin_sar_mode,
          .check = check_sar_mode,
          .end = end_sar_mode,
          .check_at_end = check_windows_have_limits};
}

}  // namespace

std::vector<FormSchema> mode_forms() {
  return {{.name = "Mode", .purpose = "any mode", .slots = plain_mode_slots()},
          {.name = "OffMode", .base = "Mode", .purpose = "the radar is off", .slots = plain_mode_slots()},
          {.name = "StbyMode", .base = "Mode", .purpose = "the radar stands by", .slots = plain_mode_slots()},
          real_beam_mode(),
          sar_mode()};
}

namespace {

std::string count_text(std::size_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what);
}

// Rule: limits for every window, minimum below maximum, and blank windows that the table has.
std::optional<ConstraintViolation> check_limits(const ConfigurationBuilder& builder) {
  const radar::WindowLimits& table = builder.radar.window_limits;
  const std::size_t windows = table.windows_nm.size();
  for (const auto& [slot, limits] :
       {std::pair{"least", &table.min_range_nm}, std::pair{"greatest", &table.max_range_nm}}) {
    if (limits->size() != windows)
      return ConstraintViolation{slot, count_text(windows, "numbers, one a window of :windows"),
                                 std::to_string(limits->size())};
  }
  for (std::size_t i = 0; i < windows; ++i) {
    if (table.min_range_nm[i] < table.max_range_nm[i]) continue;
    return ConstraintViolation{"greatest",
                               "more than the least range of the window " + number_text(table.windows_nm[i]) + ", " +
                                   number_text(table.min_range_nm[i]) + " NM",
                               number_text(table.max_range_nm[i])};
  }
  const std::size_t blank = table.blank_windows_nm.size();
  if (table.blank_max_range_nm.size() != blank) {
    return ConstraintViolation{"blankUpTo", count_text(blank, "numbers, one a window of :blankWindows"),
                               std::to_string(table.blank_max_range_nm.size())};
  }
  for (const double window_nm : table.blank_windows_nm) {
    if (radar::cursor_limits(geo::Length::nautical_miles(window_nm), table)) continue;
    return ConstraintViolation{"blankWindows", "windows of :windows", number_text(window_nm)};
  }
  return std::nullopt;
}

std::optional<ConstraintViolation> check_heights(const ConfigurationBuilder& builder) {
  const radar::HeightRanges& table = builder.radar.height_ranges;
  const std::size_t wanted = table.heights_ft.size() + 1;
  if (table.ranges_nm.size() == wanted) return std::nullopt;
  return ConstraintViolation{"ranges", count_text(wanted, "numbers, one more than :heights"),
                             std::to_string(table.ranges_nm.size())};
}

// Slot of a list in nautical miles.
SlotSchema miles(std::string_view name, double lowest, ListSlot binding, std::string_view purpose) {
  return {
      .name = name, .unit = "NM", .lowest = lowest, .highest = 1000, .binding = std::move(binding), .purpose = purpose};
}

FormSchema window_limits() {
  return {
      .name = "WindowLimits",
      .purpose = "where the cursor may be for each display window",
      .slots = {miles("windows", 0.1, {YARS_FIELD(radar.window_limits.windows_nm), 1, 16, Order::ascending},
                      "display windows; at least those of SarMode"),
                miles("least", 0, {YARS_FIELD(radar.window_limits.min_range_nm), 1, 16},
                      "least cursor range, a number a window"),
                miles("greatest", 0.1, {YARS_FIELD(radar.window_limits.max_range_nm), 1, 16},
                      "greatest cursor range, a number a window"),
                number_slot("blankLeast", "NM", 0, 1000, {YARS_FIELD(radar.window_limits.blank_min_range_nm)},
                            "nearer than this a map without a window is rejected"),
                miles("blankWindows", 0.1, {YARS_FIELD(radar.window_limits.blank_windows_nm), 1, 16},
                      "windows that a map without one takes, by cursor range"),
                miles("blankUpTo", 0.1, {YARS_FIELD(radar.window_limits.blank_max_range_nm), 1, 16, Order::ascending},
                      "greatest cursor range of each of them; beyond the last, rejected"),
                number_slot("powerUp", "NM", 0.1, 1000, {YARS_FIELD(radar.window_limits.power_up_nm)},
                            "selected at power-up, or the largest window below")},
      .check = check_limits,
      .check_at_end = check_windows_have_limits};
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

std::optional<ConstraintViolation> check_windows_have_limits(const ConfigurationBuilder& builder) {
  for (const double window_nm : builder.radar.windows_nm) {
    if (radar::cursor_limits(geo::Length::nautical_miles(window_nm), builder.radar.window_limits)) continue;
    return ConstraintViolation{
        "windows", "every window of SarMode among the windows of WindowLimits, with a least and a greatest range",
        "none for " + number_text(window_nm) + " NM"};
  }
  return std::nullopt;
}

std::vector<FormSchema> limit_forms() {
  return {window_limits(), height_ranges()};
}

namespace {

// Rule: the start position is within the gimbal limits; in azimuth within 180 deg for a circular scan.
std::optional<ConstraintViolation> check_start_position(const ConfigurationBuilder& builder) {
  const radar::AntennaConfiguration& antenna = builder.radar.antenna;
  const double azimuth_deg = antenna.circular_scan ? 180.0 : antenna.azimuth_limit_deg;
  if (std::abs(antenna.start_azimuth_deg) <= azimuth_deg &&
      std::abs(antenna.start_elevation_deg) <= antenna.elevation_limit_deg) {
    return std::nullopt;
  }
  return ConstraintViolation{
      "position",
      "a position within the gimbal, " + number_text(azimuth_deg) + " and " + number_text(antenna.elevation_limit_deg) +
          " deg either way",
      number_text(antenna.start_azimuth_deg) + " and " + number_text(antenna.start_elevation_deg)};
}

}  // namespace

std::vector<FormSchema> antenna_forms() {
  FormSchema servo{.name = "AntennaServo",
                   .purpose = "the dish, its gimbal and its servo",
                   .slots = {{.name = "azimuthLimits",
                              .unit = "deg",
                              .lowest = 1,
                              .highest = 180,
                              .binding = SymmetricSlot{YARS_FIELD(radar.antenna.azimuth_limit_deg)},
                              .purpose = "gimbal, left and right of the nose"},
                             {.name = "elevationLimits",
                              .unit = "deg",
                              .lowest = 1,
                              .highest = 90,
                              .binding = SymmetricSlot{YARS_FIELD(radar.antenna.elevation_limit_deg)},
                              .purpose = "gimbal, down and up"},
                             {.name = "maxRates",
                              .unit = "deg/s",
                              .lowest = 1,
                              .highest = 1000,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.azimuth_rate_dps),
                                                  YARS_FIELD(radar.antenna.elevation_rate_dps)},
                              .purpose = "in azimuth and elevation"},
                             {.name = "beamWidth",
                              .unit = "deg",
                              .lowest = 0.1,
                              .highest = 30,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.azimuth_beamwidth_deg),
                                                  YARS_FIELD(radar.antenna.elevation_beamwidth_deg)},
                              .purpose = "one-way 3 dB, in azimuth and elevation"},
                             {.name = "position",
                              .unit = "deg",
                              .lowest = -180,
                              .highest = 180,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.start_azimuth_deg),
                                                  YARS_FIELD(radar.antenna.start_elevation_deg)},
                              .purpose = "azimuth and elevation at start; the elevation commanded at power-up"},
                             {.name = "tolerance",
                              .unit = "deg",
                              .lowest = 0.001,
                              .highest = 5,
                              .binding = NumberSlot{YARS_FIELD(radar.antenna.tolerance_deg)},
                              .purpose = "a commanded position counts as reached within this"},
                             {.name = "driftLimit",
                              .unit = "deg",
                              .lowest = 0,
                              .highest = 60,
                              .binding = NumberSlot{YARS_FIELD(radar.antenna.drift_limit_deg)},
                              .purpose = "the scan follows the ground track up to this drift"}},
                   .check = check_start_position};
  FormSchema scan{
      .name = "RbmAntenna",
      .purpose = "the scan of the real beam map",
      .slots = {{.name = "scanWidths",
                 .unit = "deg",
                 .lowest = 1,
                 .highest = 360,
                 .binding = ListSlot{YARS_FIELD(radar.scan_widths_deg), 3, 3, Order::descending},
                 .purpose = "FULL, HALF, QTR"},
                {.name = "scanBars",
                 .lowest = 1,
                 .highest = 4,
                 .binding = FirstSlot{YARS_FIELD(radar.antenna.scan_bars)},
                 .purpose = "elevation bars of the real beam map and of beacons; of a list of patterns the first"},
                {.name = "circularScan",
                 .binding = BooleanSlot{YARS_FIELD(radar.antenna.circular_scan)},
                 .purpose = "the dish goes round instead of back and forth"}}};
  return {servo, scan};
}

}  // namespace yars::config
