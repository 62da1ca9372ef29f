#include <cmath>
#include <limits>

#include "config/field.hpp"
#include "config/forms.hpp"

namespace yars::config {
namespace {

constexpr double kMostCode = 99;

std::optional<Complaint> check_beacon(const Draft& draft) {
  if (draft.radar.world.beacons.beacons.size() >= radar::kMostBeacons)
    return Complaint{"latitude", "at most " + std::to_string(radar::kMostBeacons) + " beacons", "one more"};
  if (std::isnan(draft.beacon.place.latitude_deg)) return Complaint{"latitude", "a latitude", "none"};
  if (std::isnan(draft.beacon.place.longitude_deg)) return Complaint{"longitude", "a longitude", "none"};
  return std::nullopt;
}

SlotSchema whole_number(std::string_view name, double lowest, double highest, int& (*of)(Draft&),
                        std::string_view purpose) {
  return {.name = name, .lowest = lowest, .highest = highest, .binding = IntegerSlot{of}, .purpose = purpose};
}

FormSchema beacon() {
  return {
      .name = "Beacon",
      .purpose = "a radar beacon on the ground: it answers a pulse of its code by a train of pulses",
      .slots = {{.name = "name", .binding = TextSlot{YARS_FIELD(beacon.name)}, .purpose = "what people call it"},
                latitude_slot(YARS_FIELD(beacon.place.latitude_deg)),
                longitude_slot(YARS_FIELD(beacon.place.longitude_deg)),
                number_slot("altitude", "ft", -1500, 100'000, {YARS_FIELD(beacon.altitude_m), geo::kMetresPerFoot},
                            "above mean sea level; left out: a mast of 10 m on the ground"),
                whole_number("code", 1, kMostCode, YARS_FIELD(beacon.code), "that it answers to; left out: 1"),
                number_slot("delay", "us", 0, 1000, {YARS_FIELD(beacon.delay_us)},
                            "from the pulse that it hears to its first reply; left out: 2"),
                whole_number("replies", 2, radar::kMostReplies, YARS_FIELD(beacon.replies), "to a pulse; left out: 2"),
                number_slot("spacing", "us", 0.1, 1000, {YARS_FIELD(beacon.spacing_us)},
                            "between replies; left out: 10"),
                number_slot("power", "W", 0, 1e9, {YARS_FIELD(beacon.power_w)}, "effective radiated; left out: 100")},
      .part_of_value = true,
      .begin =
          [](Draft& draft) {
            draft.beacon = {.name = {}, .place = {kNotGiven, kNotGiven}};
          },
      .check = check_beacon,
      .end = [](Draft& draft) { draft.radar.world.beacons.beacons.push_back(draft.beacon); },
      .count = [](const Draft& draft) { return draft.radar.world.beacons.beacons.size(); },
      .select = [](Draft& draft, std::size_t index) { draft.beacon = draft.radar.world.beacons.beacons[index]; }};
}

}  // namespace

std::vector<FormSchema> beacon_forms() {
  return {{.name = "Beacons",
           .purpose = "radar beacons, and the code that the radar asks for; replaces earlier ones",
           .slots = {{.name = "beacons",
                      .binding = FormSlot{{"Beacon"}, {"Beacon"}, true},
                      .purpose = "at most 64 beacons"},
                     whole_number("beaconCode", 1, kMostCode, YARS_FIELD(radar.world.beacons.code),
                                  "that the radar asks for: beacons of another stay silent")},
           .begin = [](Draft& draft) { draft.radar.world.beacons.beacons.clear(); }},
          beacon()};
}

}  // namespace yars::config
