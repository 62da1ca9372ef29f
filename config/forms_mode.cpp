#include <algorithm>
#include <utility>

#include "config/field.hpp"
#include "config/forms.hpp"

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

// A map's samples and sweep lines are its pixels; 1996 gave them apart.
SlotSchema map_edge(std::string_view name, IntegerSlot binding, std::string_view purpose) {
  return {.name = name,
          .lowest = 16,
          .highest = 1024,
          .binding = binding,
          .purpose = purpose,
          .same_as = "mapSize of Fidelity"};
}

void begin_sar_mode(Draft& draft) {
  draft.map_samples = 0;
  draft.map_sweeps = 0;
}

std::optional<Complaint> check_sar_mode(const Draft& draft) {
  if (draft.map_samples == 0 || draft.map_sweeps == 0 || draft.map_samples == draft.map_sweeps) return std::nullopt;
  return Complaint{"width", "the samples, " + std::to_string(draft.map_samples) + " (maps are square)",
                   std::to_string(draft.map_sweeps)};
}

void end_sar_mode(Draft& draft) {
  const int given = std::max(draft.map_samples, draft.map_sweeps);
  if (given > 0) draft.radar.fidelity.map_size = given;
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
          .agree = check_windows_have_limits};
}

}  // namespace

std::vector<FormSchema> mode_forms() {
  return {{.name = "Mode", .purpose = "any mode", .slots = plain_mode_slots()},
          {.name = "OffMode", .base = "Mode", .purpose = "the radar is off", .slots = plain_mode_slots()},
          {.name = "StbyMode", .base = "Mode", .purpose = "the radar stands by", .slots = plain_mode_slots()},
          real_beam_mode(),
          sar_mode()};
}

}  // namespace yars::config
