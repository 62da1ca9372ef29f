// Forms of the configuration language GUF with their slots (schema.hpp): modes, cursor limits, height ranges, antenna.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"

namespace yars::config {

namespace {

using Names = std::vector<std::string_view>;

std::vector<SlotSchema> mode_slots(const Names& displays, const Names& antennas, IntegerSlot samples) {
  return {
      {.name = "display",
       .binding = FormSlot{{"Display", "RbmDisplay", "SarDisplay", "MgDisplay"}, displays},
       .purpose = "display of the mode"},
      {.name = "antenna", .binding = FormSlot{{"RbmAntenna", "AntennaServo"}, antennas}, .purpose = "scan of the mode"},
      {.name = "databases",
       .binding = FormSlot{{"Database", "DedDbase", "MgDbase", "Terrain"}, {}, true},
       .purpose = "terrain of the mode",
       .same_as = "terrain of Apg70"},
      {.name = "samples",
       .lowest = values::ScanRequest::samples.low,
       .highest = values::ScanRequest::samples.high,
       .binding = samples,
       .purpose = values::ScanRequest::samples.purpose,
       .instead = samples.of != nullptr ? "" : "samples of RealBeamMode and SarMode",
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
                               .purpose = "sweeps of the 1996 scan",
                               .instead = "a sweep a tick of 5 ms, at maxRates of AntennaServo"},
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

// Slot for the edge length [pixels] of a map. SarMode of the 1996 report has one slot for samples and one for sweep
// lines. Maps are square, so both must be equal if both are given.
SlotSchema map_edge(std::string_view name, IntegerSlot binding, std::string_view purpose) {
  return {.name = name,
          .lowest = 16,
          .highest = 4096,
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
                             {map_edge("width", {YARS_FIELD(map_sweeps)}, "sweep lines of a map, equal to samples"),
                              {.name = "patchSizes",
                               .unit = "m",
                               .lowest = 1,
                               .highest = 200'000,
                               .binding = ListSlot{nullptr, 1, 16},
                               .purpose = "patch sizes of 1996 by range",
                               .instead = "windows, in NM, which the pilot selects"},
                              {.name = "windows",
                               .unit = "NM",
                               .lowest = 0.1,
                               .highest = 500,
                               .binding = ListSlot{YARS_FIELD(radar.windows_nm), 1, 16, Order::ascending},
                               .purpose = "selectable display windows; WindowLimits must list each of them"}}),
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

// Rules: each display window has a minimum and a greater maximum cursor range. The slot blankWindows lists the windows
// for a map without a selected window. Each of them has a maximum cursor range, and also occurs in the slot windows.
std::optional<ConstraintViolation> check_limits(const ConfigurationBuilder& builder) {
  const radar::WindowLimits& table = builder.radar.window_limits;
  const std::size_t windows = table.windows_nm.size();
  for (const auto& [slot, limits] :
       {std::pair{"least", &table.min_range_nm}, std::pair{"greatest", &table.max_range_nm}}) {
    if (limits->size() != windows)
      return ConstraintViolation{slot, count_text(windows, "numbers, one for each of :windows,"),
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
    return ConstraintViolation{"blankUpTo", count_text(blank, "numbers, one for each of :blankWindows,"),
                               std::to_string(table.blank_max_range_nm.size())};
  }
  for (const double window_nm : table.blank_windows_nm) {
    if (radar::cursor_limits(geo::Length::nautical_miles(window_nm), table)) continue;
    return ConstraintViolation{"blankWindows", "windows that :windows lists", number_text(window_nm)};
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

// Slot with a list of distances in nautical miles.
SlotSchema miles(std::string_view name, double lowest, ListSlot binding, std::string_view purpose) {
  return {.name = name, .unit = "NM", .lowest = lowest, .highest = 1000, .binding = binding, .purpose = purpose};
}

FormSchema window_limits() {
  return {
      .name = "WindowLimits",
      .purpose = "limits of the cursor range for each window of patch maps",
      .slots = {miles("windows", 0.1, {YARS_FIELD(radar.window_limits.windows_nm), 1, 16, Order::ascending},
                      "display windows; at least those of SarMode"),
                miles("least", 0, {YARS_FIELD(radar.window_limits.min_range_nm), 1, 16},
                      "minimum cursor range, one number per window"),
                miles("greatest", 0.1, {YARS_FIELD(radar.window_limits.max_range_nm), 1, 16},
                      "maximum cursor range, one number per window"),
                number_slot("blankLeast", "NM", 0, 1000, {YARS_FIELD(radar.window_limits.blank_min_range_nm)},
                            "minimum cursor range of a map without a selected window"),
                miles("blankWindows", 0.1, {YARS_FIELD(radar.window_limits.blank_windows_nm), 1, 16},
                      "windows for a map without a selected window, by cursor range"),
                miles("blankUpTo", 0.1, {YARS_FIELD(radar.window_limits.blank_max_range_nm), 1, 16, Order::ascending},
                      "maximum cursor range for each of blankWindows; beyond the last, a map is rejected"),
                number_slot("powerUp", "NM", 0.1, 1000, {YARS_FIELD(radar.window_limits.power_up_nm)},
                            "window at power-up; if not selectable or longer than the range, the next smaller one")},
      .check = check_limits,
      .check_at_end = check_windows_have_limits};
}

FormSchema height_ranges() {
  return {.name = "HeightRanges",
          .purpose = "range that the radar selects by itself, at power-up and on a mode change",
          .slots = {{.name = "heights",
                     .unit = "ft",
                     .lowest = 0,
                     .highest = 100'000,
                     .binding = ListSlot{YARS_FIELD(radar.height_ranges.heights_ft), 1, 15, Order::ascending},
                     .purpose = "limits of height over ground or sea; a height equal to a limit has the shorter range"},
                    miles("ranges", 0.1, {YARS_FIELD(radar.height_ranges.ranges_nm), 2, 16, Order::ascending},
                          "a range for heights up to each limit, and one above the last; the shortest selectable range "
                          "of at least this length is used")},
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

// Rule: the antenna's start position is within the gimbal limits. For a circular scan the azimuth limit is 180 deg.
std::optional<ConstraintViolation> check_start_position(const ConfigurationBuilder& builder) {
  const radar::AntennaConfiguration& antenna = builder.radar.antenna;
  const double azimuth_deg = antenna.circular_scan ? 180.0 : antenna.azimuth_limit_deg;
  if (std::abs(antenna.start_azimuth_deg) <= azimuth_deg &&
      std::abs(antenna.start_elevation_deg) <= antenna.elevation_limit_deg) {
    return std::nullopt;
  }
  return ConstraintViolation{
      "position",
      "a position within the gimbal limits, +-" + number_text(azimuth_deg) + " and +-" +
          number_text(antenna.elevation_limit_deg) + " deg,",
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
                              .purpose = "gimbal limits, left and right of the nose"},
                             {.name = "elevationLimits",
                              .unit = "deg",
                              .lowest = 1,
                              .highest = 90,
                              .binding = SymmetricSlot{YARS_FIELD(radar.antenna.elevation_limit_deg)},
                              .purpose = "gimbal limits, down and up"},
                             {.name = "maxRates",
                              .unit = "deg/s",
                              .lowest = 1,
                              .highest = 1000,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.azimuth_rate_dps),
                                                  YARS_FIELD(radar.antenna.elevation_rate_dps)},
                              .purpose = "maximum antenna rates in azimuth and elevation"},
                             {.name = "beamWidth",
                              .unit = "deg",
                              .lowest = 0.1,
                              .highest = 30,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.azimuth_beamwidth_deg),
                                                  YARS_FIELD(radar.antenna.elevation_beamwidth_deg)},
                              .purpose = "one-way 3 dB beam width in azimuth and elevation"},
                             {.name = "position",
                              .unit = "deg",
                              .lowest = -180,
                              .highest = 180,
                              .binding = PairSlot{YARS_FIELD(radar.antenna.start_azimuth_deg),
                                                  YARS_FIELD(radar.antenna.start_elevation_deg)},
                              .purpose = "azimuth and elevation at start; the elevation is also commanded at power-up"},
                             {.name = "tolerance",
                              .unit = "deg",
                              .lowest = 0.001,
                              .highest = 5,
                              .binding = NumberSlot{YARS_FIELD(radar.antenna.tolerance_deg)},
                              .purpose = "maximum error at which a commanded position counts as reached"},
                             {.name = "driftLimit",
                              .unit = "deg",
                              .lowest = 0,
                              .highest = 60,
                              .binding = NumberSlot{YARS_FIELD(radar.antenna.drift_limit_deg)},
                              .purpose = "the scan centre follows the ground track up to this drift angle"}},
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
                 .purpose = "elevation bars of the real beam map and of beacons; of a list, the first number is used"},
                {.name = "circularScan",
                 .binding = BooleanSlot{YARS_FIELD(radar.antenna.circular_scan)},
                 .purpose = "the antenna rotates instead of scanning back and forth"}}};
  return {servo, scan};
}

}  // namespace yars::config
