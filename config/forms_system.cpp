#include "config/field.hpp"
#include "config/forms.hpp"
#include "config/value.hpp"

namespace yars::config {
namespace {

std::optional<Complaint> check_widths_against_gimbal(const Draft& draft) {
  const auto& radar = draft.radar;
  const double widest_deg = radar.scan_widths_deg.front();
  const double reach_deg = 2.0 * radar.antenna.azimuth_limit_deg;
  if (radar.antenna.circular_scan || widest_deg <= reach_deg) return std::nullopt;
  return Complaint{"modes", "scan widths within the gimbal's " + number_text(reach_deg) + " deg",
                   number_text(widest_deg) + " deg"};
}

// Positions 1 to 11 are the report's.
std::vector<SlotSchema> reported_slots() {
  return {
      {.name = "display",
       .binding = FormSlot{{"Window", "Display", "RbmDisplay", "SarDisplay", "MgDisplay"}, {"Window"}},
       .purpose = "the glass"},
      {.name = "antenna",
       .binding = FormSlot{{"AntennaServo", "RbmAntenna"}, {"AntennaServo"}},
       .purpose = "the dish and its servo"},
      {.name = "databases",
       .binding = FormSlot{{"Database", "DedDbase", "MgDbase", "Terrain"}, {}, true},
       .purpose = "terrain of all modes",
       .same_as = "terrain"},
      {.name = "samples",
       .lowest = 1,
       .highest = 4096,
       .binding = IntegerSlot{YARS_FIELD(radar.fidelity.samples)},
       .purpose = "samples of a sweep",
       .same_as = "samples of Fidelity"},
      {.name = "modes",
       .binding = FormSlot{{"Mode", "OffMode", "StbyMode", "RealBeamMode", "SarMode"},
                           {"OffMode", "StbyMode", "RealBeamMode", "SarMode"},
                           true},
       .purpose = "the modes of the radar"},
      {.name = "ranges",
       .unit = "NM",
       .lowest = 0.1,
       .highest = 500,
       .binding = ListSlot{YARS_FIELD(radar.ranges_nm), 1, 16, Order::ascending},
       .purpose = "ranges that can be selected"},
      {.name = "rate",
       .unit = "Hz",
       .lowest = 1,
       .highest = 1000,
       .binding = NumberSlot{},
       .purpose = "updates of the 1996 main loop"},
      {.name = "latitude",
       .unit = "deg",
       .lowest = -90,
       .highest = 90,
       .binding = AngleSlot{nullptr, true},
       .purpose = "place of the radar at start"},
      {.name = "longitude",
       .unit = "deg",
       .lowest = -180,
       .highest = 180,
       .binding = AngleSlot{nullptr, false},
       .purpose = "place of the radar at start"},
      {.name = "altitude",
       .unit = "ft",
       .lowest = -1500,
       .highest = 100'000,
       .binding = NumberSlot{},
       .purpose = "height of the radar at start"},
      {.name = "heading",
       .unit = "deg",
       .lowest = -360,
       .highest = 360,
       .binding = NumberSlot{},
       .purpose = "heading of the radar at start"},
  };
}

std::vector<SlotSchema> system_slots() {
  return with_base(
      reported_slots(),
      {{.name = "name", .binding = TextSlot{YARS_FIELD(radar.name)}, .purpose = "what people call this radar"},
       {.name = "pulseWidths",
        .unit = "us",
        .lowest = 0.01,
        .highest = 100,
        .binding = ListSlot{YARS_FIELD(radar.pulse_us), 1, 16, Order::any},
        .purpose = "pulse length by range; the last serves whatever lies beyond"},
       {.name = "magneticVariation",
        .unit = "deg",
        .lowest = -180,
        .highest = 180,
        .binding = NumberSlot{YARS_FIELD(radar.magnetic_variation_deg)},
        .purpose = "magnetic from true, east positive"},
       {.name = "fidelity", .binding = FormSlot{{"Fidelity"}, {"Fidelity"}}, .purpose = "speed against accuracy"},
       {.name = "receiver", .binding = FormSlot{{"Receiver"}, {"Receiver"}}, .purpose = "receiver and ground return"},
       {.name = "noise", .binding = FormSlot{{"Noise"}, {"Noise"}}, .purpose = "thermal noise and speckle"},
       {.name = "terrain", .binding = FormSlot{{"Terrain"}, {"Terrain"}}, .purpose = "where the ground comes from"},
       {.name = "route", .binding = FormSlot{{"Route"}, {"Route"}}, .purpose = "sequence points"},
       {.name = "land", .binding = FormSlot{{"Land"}, {"Land"}}, .purpose = "what land returns"},
       {.name = "materials", .binding = FormSlot{{"Materials"}, {"Materials"}}, .purpose = "what materials return"},
       {.name = "sea", .binding = FormSlot{{"Sea"}, {"Sea"}}, .purpose = "what the sea returns"},
       {.name = "rain", .binding = FormSlot{{"Rain"}, {"Rain"}}, .purpose = "showers"},
       {.name = "jammers", .binding = FormSlot{{"Jammers"}, {"Jammers"}}, .purpose = "jammers"},
       {.name = "movers", .binding = FormSlot{{"Movers"}, {"Movers"}}, .purpose = "ships and vehicles"},
       {.name = "scenes", .binding = FormSlot{{"Scenes"}, {"Scenes"}}, .purpose = "polygonal scenes"},
       {.name = "highResolution",
        .binding = FormSlot{{"HighResolution"}, {"HighResolution"}},
        .purpose = "high resolution maps"},
       {.name = "navigation",
        .binding = FormSlot{{"Navigation"}, {"Navigation"}},
        .purpose = "errors of the navigators, and their updates"},
       {.name = "windowLimits",
        .binding = FormSlot{{"WindowLimits"}, {"WindowLimits"}},
        .purpose = "where the cursor may be for each display window"},
       {.name = "heightRanges",
        .binding = FormSlot{{"HeightRanges"}, {"HeightRanges"}},
        .purpose = "the range by height"},
       {.name = "beacons", .binding = FormSlot{{"Beacons"}, {"Beacons"}}, .purpose = "radar beacons"},
       {.name = "devices", .binding = FormSlot{{"Devices"}, {"Devices"}}, .purpose = "maps of cockpit hardware"},
       {.name = "atmosphere",
        .binding = FormSlot{{"Atmosphere"}, {"Atmosphere"}},
        .purpose = "the air, and what its gases take"}});
}

}  // namespace

std::vector<FormSchema> system_forms() {
  return {{.name = "System",
           .purpose = "a radar of any type",
           .slots = system_slots(),
           .old_name = "Radar",
           .check = check_widths_against_gimbal},
          {.name = "Apg70",
           .base = "System",
           .purpose = "the radar",
           .slots = system_slots(),
           .check = check_widths_against_gimbal}};
}

}  // namespace yars::config
