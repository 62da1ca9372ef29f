// Forms of the configuration language GUF with their slots (schema.hpp): jammers, movers, scenes, beacons.
#include <algorithm>
#include <array>
#include <cmath>

#include "config/guf/parser.hpp"
#include "config/schema/list_forms.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/cross_section.hpp"
#include "lib/radar/world.hpp"

namespace yars::config {

namespace {

using radar::kNotGiven;

// Words in the order of radar::Jammer::band.
constexpr std::array<std::string_view, 6> kBands{"A", "B", "C", "D", "E", "all"};
constexpr int kAllBands = 5;  // index of "all" in kBands

std::optional<ConstraintViolation> check_jammer(const ConfigurationBuilder& builder) {
  const auto& channels = std::get<radar::Jammer>(builder.entries.of).channels;
  const auto fractional =
      std::find_if(channels.begin(), channels.end(), [](double channel) { return channel != std::floor(channel); });
  if (fractional != channels.end()) return ConstraintViolation{"channels", "whole numbers", number_text(*fractional)};
  return check_entry_read<radar::Jammer>(builder);
}

FormSchema jammer() {
  FormSchema form = entry_form<radar::Jammer>();
  form.check = check_jammer;
  form.slots.insert(form.slots.end() - 1,  // before the power
                    {SlotSchema{.name = "band",
                                .binding = ChoiceSlot{kBands,
                                                      [](const ConfigurationBuilder& builder) {
                                                        const int band =
                                                            std::get<radar::Jammer>(builder.entries.of).band;
                                                        return band == radar::kEveryBand ? kAllBands : band;
                                                      },
                                                      [](ConfigurationBuilder& builder, int index) {
                                                        entry_read<radar::Jammer>(builder).band =
                                                            index == kAllBands ? radar::kEveryBand : index;
                                                      }},
                                .purpose = "band that it jams; left out: all"},
                     SlotSchema{.name = "channels",
                                .lowest = 1,
                                .highest = radar::kChannels,
                                .binding = ListSlot{[](ConfigurationBuilder& builder) -> auto& {
                                                      return entry_read<radar::Jammer>(builder).channels;
                                                    },
                                                    1, radar::kChannels, Order::ascending},
                                .purpose = "channels that it jams; left out: all"}});
  return form;
}

FormSchema jammers() {
  FormSchema form = list_form<radar::Jammer>(
      "jammers", {number_slot("radarPower", "dBW", 0, 120, {YARS_FIELD(radar.world.jamming.radar_power_dbw)},
                              "the radar's effective radiated peak power"),
                  number_slot("sidelobes", "dB", -80, 0, {YARS_FIELD(radar.world.jamming.sidelobe_db)},
                              "minimum one-way gain of the antenna, relative to the beam centre")});
  form.purpose = "jammers, and the power and sidelobes of the jammed radar";
  return form;
}

// Cross section that the displacement of a ship or the edge of a reflector gives; NaN: neither is given.
double cross_section_by_size(const radar::Mover& mover, double frequency_ghz) {
  if (!std::isnan(mover.displacement_t)) return radar::ship_cross_section_m2(mover.displacement_t, frequency_ghz);
  if (std::isnan(mover.edge_m)) return kNotGiven;
  return radar::reflector_cross_section_m2(mover.echo, mover.edge_m, frequency_ghz);
}

void begin_mover(ConfigurationBuilder& builder) {
  radar::Mover& mover = entry_read<radar::Mover>(builder) = {};
  mover.position = {kNotGiven, kNotGiven};
  mover.cross_section_m2 = kNotGiven;
}

std::optional<ConstraintViolation> check_mover(const ConfigurationBuilder& builder) {
  const auto& mover = std::get<radar::Mover>(builder.entries.of);
  const std::string echo(radar::kTargetEchoNames.at(static_cast<std::size_t>(mover.echo)));
  const bool reflector = radar::is_reflector(mover.echo);
  const int sizes = static_cast<int>(!std::isnan(mover.cross_section_m2)) +
                    static_cast<int>(!std::isnan(mover.displacement_t)) + static_cast<int>(!std::isnan(mover.edge_m));
  if (sizes > 1) return ConstraintViolation{"crossSection", "one of crossSection, displacement and edge", "several"};
  if (reflector && !std::isnan(mover.displacement_t))
    return ConstraintViolation{"displacement", "a displacement without a reflector's echo", "the echo " + echo};
  const bool has_axis = mover.facing_deg != 0 || mover.tilt_deg != 0;
  if (!reflector && (has_axis || !std::isnan(mover.edge_m)))
    return ConstraintViolation{has_axis ? "facing" : "edge", "the echo trihedral or dihedral", echo};
  return check_entry_read<radar::Mover>(builder);
}

// The radar's frequency is known when all forms are read.
std::optional<ConstraintViolation> check_sizes(const ConfigurationBuilder& builder) {
  for (const radar::Mover& mover : builder.radar.world.movers) {
    const double found_m2 = cross_section_by_size(mover, builder.radar.receiver.frequency_ghz);
    const double most_m2 = values::WorldMover::cross_section.high;
    if (found_m2 > most_m2)
      return ConstraintViolation{"", "a size with a cross section of at most " + number_text(most_m2) + " m2",
                                 number_text(std::round(found_m2)) + " m2 of " + mover.name};
  }
  return std::nullopt;
}

FormSchema mover() {
  FormSchema form = entry_form<radar::Mover>();
  form.begin = begin_mover;
  form.check = check_mover;
  form.check_at_end = check_sizes;
  form.end = [](ConfigurationBuilder& builder) {
    radar::Mover read = entry_read<radar::Mover>(builder);
    if (std::isnan(read.cross_section_m2)) read.cross_section_m2 = radar::Mover().cross_section_m2;
    entries_of<radar::Mover>(builder).push_back(read);
  };
  // What gives the cross section is printed instead of it.
  form.select = [](ConfigurationBuilder& builder, std::size_t index) {
    radar::Mover& read = entry_read<radar::Mover>(builder) = entries_of<radar::Mover>(builder)[index];
    if (!std::isnan(cross_section_by_size(read, 1.0))) read.cross_section_m2 = kNotGiven;
  };
  const auto whole = [](std::string_view name, double lowest, double highest, int& (*of)(ConfigurationBuilder&),
                        std::string_view purpose) {
    return SlotSchema{.name = name,
                      .unit = "deg",
                      .lowest = lowest,
                      .highest = highest,
                      .binding = IntegerSlot{of},
                      .purpose = purpose};
  };
  form.slots.push_back(number_slot(
      "displacement", "t", 1, 1e6,
      {[](ConfigurationBuilder& builder) -> auto& { return entry_read<radar::Mover>(builder).displacement_t; }},
      "full load displacement of a ship, from which its cross section follows; instead of crossSection"));
  form.slots.push_back(
      {.name = "echo",
       .binding = ChoiceSlot{radar::kTargetEchoNames,
                             [](const ConfigurationBuilder& builder) {
                               return static_cast<int>(std::get<radar::Mover>(builder.entries.of).echo);
                             },
                             [](ConfigurationBuilder& builder, int index) {
                               entry_read<radar::Mover>(builder).echo = static_cast<radar::TargetEcho>(index);
                             }},
       .purpose = "swerling1, swerling3: fluctuates from scan to scan, with noise of Fidelity, except in 1996; steady; "
                  "trihedral, dihedral: a corner reflector, steady, with an aspect; left out: swerling1"});
  form.slots.push_back(
      number_slot("edge", "m", 0.01, 10,
                  {[](ConfigurationBuilder& builder) -> auto& { return entry_read<radar::Mover>(builder).edge_m; }},
                  "edge of a reflector, from which its cross section on the axis follows; instead of crossSection"));
  form.slots.push_back(whole(
      "facing", 0, 359,
      [](ConfigurationBuilder& builder) -> auto& { return entry_read<radar::Mover>(builder).facing_deg; },
      "true azimuth of a reflector's axis; left out: 0"));
  form.slots.push_back(whole(
      "tilt", -90, 90,
      [](ConfigurationBuilder& builder) -> auto& { return entry_read<radar::Mover>(builder).tilt_deg; },
      "elevation of a reflector's axis above the horizontal; left out: 0"));
  return form;
}

// Words in the order of radar::SceneHeights.
constexpr std::array<std::string_view, 3> kSceneHeights{"ground", "anchor", "seaLevel"};

std::optional<ConstraintViolation> check_scene(const ConfigurationBuilder& builder) {
  if (builder.radar.world.scenes.size() >= radar::kMaxScenes) {
    return ConstraintViolation{"file", "at most " + std::to_string(radar::kMaxScenes) + " scenes", "one more"};
  }
  const radar::Scene& scene = builder.scene;
  if (scene.file.empty()) return ConstraintViolation{"file", "an OpenFlight file or a folder of them", "none"};
  if (std::isnan(scene.position.latitude_deg) == std::isnan(scene.position.longitude_deg)) return std::nullopt;
  return ConstraintViolation{"latitude", "latitude and longitude together, or neither", "one of them"};
}

FormSchema scene() {
  return {
      .name = "Scene",
      .purpose = "a polygonal scene on the earth",
      .slots = {{.name = "file",
                 .binding = PathSlot{YARS_FIELD(scene.file)},
                 .purpose = "OpenFlight file, or a folder of .flt files"},
                latitude_slot(YARS_FIELD(scene.position.latitude_deg)),
                longitude_slot(YARS_FIELD(scene.position.longitude_deg)),
                number_slot("heading", "deg", -360, 360, {YARS_FIELD(scene.heading_deg)},
                            "true bearing of the scene's north; left out: 0"),
                {.name = "elevation",
                 .binding = ChoiceSlot{
                     kSceneHeights,
                     [](const ConfigurationBuilder& builder) { return static_cast<int>(builder.scene.heights); },
                     [](ConfigurationBuilder& builder, int index) {
                       builder.scene.heights = static_cast<radar::SceneHeights>(index);
                     }},
                 .purpose =
                     "ground: each object stands on the ground below it, and flat objects follow the ground; anchor: "
                     "the scene stands on the ground at its origin; seaLevel: heights are above mean sea level"},
                {.name = "without",
                 .binding = TextSlot{YARS_FIELD(scene.without)},
                 .purpose = "omitted objects and groups by name, separated by commas; * and ? as in file names. A name "
                            "that does not occur is an error; left out: none"}},
      .part_of_value = true,
      .begin = [](ConfigurationBuilder& builder) { builder.scene = {}; },
      .check = check_scene,
      .end = [](ConfigurationBuilder& builder) { builder.radar.world.scenes.push_back(builder.scene); },
      .count = [](const ConfigurationBuilder& builder) { return builder.radar.world.scenes.size(); },
      .select = [](ConfigurationBuilder& builder,
                   std::size_t index) { builder.scene = builder.radar.world.scenes[index]; }};
}

}  // namespace

void set_cross_sections(radar::RadarConfiguration& configuration) {
  for (radar::Mover& mover : configuration.world.movers) {
    const double by_size_m2 = cross_section_by_size(mover, configuration.receiver.frequency_ghz);
    if (!std::isnan(by_size_m2)) mover.cross_section_m2 = by_size_m2;
  }
}

std::vector<FormSchema> traffic_forms() {
  return {jammers(),
          jammer(),
          mover(),
          {.name = "Scenes",
           .purpose = "polygonal scenes",
           .slots = {list_slot(
                         "scenes", "Scene", [](ConfigurationBuilder& builder) { builder.radar.world.scenes.clear(); },
                         replaced_list(radar::kMaxScenes,
                                       "scenes; a scene without position is placed by the file's name or header")),
                     more_slot("moreScenes", "Scene", "scenes", "scenes beside those of earlier forms")}},
          scene()};
}

std::vector<FormSchema> list_forms() {
  std::vector<FormSchema> forms;
  const auto add = [&forms]<class Entry>(const Entry& /*of the list*/) {
    forms.push_back(list_form<Entry>());
    forms.push_back(entry_form<Entry>());
  };
  std::apply([&add](const auto&... entry) { (add(entry), ...); }, radar::ListEntries().of);
  return forms;
}

namespace {

constexpr double kMaxCode = 99;  // greatest interrogation code of a beacon

std::optional<ConstraintViolation> check_beacon(const ConfigurationBuilder& builder) {
  return check_entry(builder.beacon.position, builder.radar.world.beacons.beacons.size(), radar::kMaxBeacons,
                     "beacons");
}

SlotSchema whole_number(std::string_view name, double lowest, double highest, int& (*of)(ConfigurationBuilder&),
                        std::string_view purpose) {
  return {.name = name, .lowest = lowest, .highest = highest, .binding = IntegerSlot{of}, .purpose = purpose};
}

FormSchema beacon() {
  return {
      .name = "Beacon",
      .purpose = "a radar beacon on the ground: replies to a pulse of its code with a train of pulses",
      .slots = {{.name = "name", .binding = TextSlot{YARS_FIELD(beacon.name)}, .purpose = "name, free text"},
                latitude_slot(YARS_FIELD(beacon.position.latitude_deg)),
                longitude_slot(YARS_FIELD(beacon.position.longitude_deg)),
                entry_slot("altitude", values::WorldJammer::altitude, YARS_FIELD(beacon.altitude_m)),
                whole_number("code", 1, kMaxCode, YARS_FIELD(beacon.code),
                             "interrogation code to which it replies; left out: 1"),
                number_slot("delay", "us", 0, 1000, {YARS_FIELD(beacon.delay_us)},
                            "time from the received pulse to the first reply; left out: 2"),
                whole_number("replies", 2, radar::kMaxReplies, YARS_FIELD(beacon.replies),
                             "number of replies to a pulse; left out: 2"),
                number_slot("spacing", "us", 0.1, 1000, {YARS_FIELD(beacon.spacing_us)},
                            "time between replies; left out: 10"),
                number_slot("power", "W", 0, 1e9, {YARS_FIELD(beacon.power_w)},
                            "effective radiated power; left out: 100")},
      .part_of_value = true,
      .begin = [](ConfigurationBuilder& builder) { builder.beacon = {.name = {}, .position = {kNotGiven, kNotGiven}}; },
      .check = check_beacon,
      .end = [](ConfigurationBuilder& builder) { builder.radar.world.beacons.beacons.push_back(builder.beacon); },
      .count = [](const ConfigurationBuilder& builder) { return builder.radar.world.beacons.beacons.size(); },
      .select = [](ConfigurationBuilder& builder,
                   std::size_t index) { builder.beacon = builder.radar.world.beacons.beacons[index]; }};
}

}  // namespace

std::vector<FormSchema> beacon_forms() {
  return {{.name = "Beacons",
           .purpose = "radar beacons, and the code that the radar interrogates",
           .slots = {list_slot(
                         "beacons", "Beacon",
                         [](ConfigurationBuilder& builder) { builder.radar.world.beacons.beacons.clear(); },
                         replaced_list(radar::kMaxBeacons, "beacons")),
                     whole_number("beaconCode", 1, kMaxCode, YARS_FIELD(radar.world.beacons.code),
                                  "code that the radar interrogates; beacons with another code do not reply"),
                     more_slot("moreBeacons", "Beacon", "beacons", "beacons beside those of earlier forms")}},
          beacon()};
}

}  // namespace yars::config
