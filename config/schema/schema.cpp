#include "config/schema/schema.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include "config/guf/parser.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/network.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

struct ConfigurationBuilder::Storage {
  radar::RadarConfiguration radar;
  radar::RoutePoint point;
  radar::Rgb color;
  radar::Material material;
  radar::ListEntries entries;
  radar::Scene scene;
  radar::Beacon beacon;
  radar::Device device;
  radar::DeviceButton device_button;
  radar::DeviceAxis device_axis;
  radar::NetworkSettings network;
  ConfigurationBuilder builder{*this};
};

ConfigurationBuilder::Sections::Sections(radar::RadarConfiguration& whole)
    : name(whole.name),
      ranges_nm(whole.ranges_nm),
      scan_widths_deg(whole.scan_widths_deg),
      windows_nm(whole.windows_nm),
      pulse_us(whole.pulse_us),
      antenna(whole.antenna),
      view(whole.view),
      fidelity(whole.fidelity),
      receiver(whole.receiver),
      terrain(whole.terrain),
      high_resolution(whole.high_resolution),
      navigation(whole.navigation),
      world(whole.world),
      route(whole.route),
      seed(whole.seed),
      magnetic_variation_deg(whole.magnetic_variation_deg),
      window_limits(whole.window_limits),
      height_ranges(whole.height_ranges),
      devices(whole.devices) {}

ConfigurationBuilder::ConfigurationBuilder(Storage& storage)
    : whole(storage.radar),
      radar(storage.radar),
      window_height_pixels(storage.radar.view.size_pixels),
      map_samples(storage.radar.fidelity.map_size),
      map_sweeps(storage.radar.fidelity.map_size),
      point(storage.point),
      color(storage.color),
      material(storage.material),
      entries(storage.entries),
      scene(storage.scene),
      beacon(storage.beacon),
      device(storage.device),
      device_button(storage.device_button),
      device_axis(storage.device_axis),
      network(storage.network) {}

BuilderPointer new_builder() {
  const auto storage = std::make_shared<ConfigurationBuilder::Storage>();
  return {storage, &storage->builder};
}

BuilderPointer builder_of(const radar::RadarConfiguration& configuration) {
  BuilderPointer builder = new_builder();
  builder->whole = configuration;
  builder->window_height_pixels = configuration.view.size_pixels;
  return builder;
}

namespace {

char lower(char letter) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

char upper(char letter) {
  return static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
}

bool equal_ignoring_case(std::string_view left, std::string_view right) {
  return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                    [](char a, char b) { return lower(a) == lower(b); });
}

template <class Schema>
Found<Schema> find_named(const std::vector<Schema>& rows, std::string_view name) {
  for (const Schema& row : rows) {
    if (row.name == name) return {&row, Spelling::exact};
  }
  for (const Schema& row : rows) {
    if (equal_ignoring_case(row.name, name)) return {&row, Spelling::other_case};
    if (!row.old_name.empty() && equal_ignoring_case(row.old_name, name)) return {&row, Spelling::old_name};
  }
  return {};
}

std::vector<FormSchema> all_forms() {
  std::vector<FormSchema> forms;
  for (const auto group :
       {system_forms, mode_forms, antenna_forms, display_forms, database_forms, model_forms, route_forms, world_forms,
        navigation_forms, traffic_forms, limit_forms, beacon_forms, device_forms, network_forms, value_forms}) {
    for (FormSchema& form : group()) forms.push_back(std::move(form));
  }
  // A form that another group has, because it has further slots, is there already.
  for (FormSchema& form : list_forms())
    if (!find_named(forms, form.name).schema) forms.push_back(std::move(form));
  return forms;
}

std::string joined(const auto& words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

std::string range_text(const SlotSchema& slot) {
  std::string text;
  if (slot.lowest > -std::numeric_limits<double>::infinity()) {
    text = " in [" + number_text(slot.lowest) + ", " + number_text(slot.highest) + "]";
  }
  return slot.unit.empty() ? text : text + " " + std::string(slot.unit);
}

struct KindText {
  const SlotSchema& slot;
  std::string operator()(const NumberSlot&) const { return "a number" + range_text(slot); }
  std::string operator()(const IntegerSlot&) const { return "a whole number" + range_text(slot); }
  std::string operator()(const CounterSlot&) const { return "a whole number" + range_text(slot); }
  std::string operator()(const BooleanSlot&) const { return "true or false"; }
  std::string operator()(const TextSlot&) const { return "a string"; }
  std::string operator()(const PathSlot&) const { return "a string, a path relative to the file that contains it"; }
  std::string operator()(const AngleSlot&) const { return "a number or a lat-long" + range_text(slot); }
  std::string operator()(const ChoiceSlot& choice) const { return "one of " + joined(choice.words); }
  std::string operator()(const ListSlot& list) const {
    const std::string count = list.min_count == list.max_count
                                  ? std::to_string(list.min_count)
                                  : std::to_string(list.min_count) + " to " + std::to_string(list.max_count);
    constexpr std::string_view kOrders[] = {"", " ascending", " descending"};
    return "a list of " + count + std::string(kOrders[static_cast<std::size_t>(list.order)]) + " numbers" +
           range_text(slot);
  }
  std::string operator()(const WordsSlot& words) const {
    return "a list of " + std::to_string(words.min_count) + " to " + std::to_string(words.max_count) + " strings";
  }
  std::string operator()(const FirstSlot&) const { return "a whole number or a list of them" + range_text(slot); }
  std::string operator()(const PairSlot&) const { return "a list of 2 numbers" + range_text(slot); }
  std::string operator()(const SpanSlot&) const { return "a list of low and high, or a number," + range_text(slot); }
  std::string operator()(const SymmetricSlot&) const {
    return "a list of -limit and limit, the limit" + range_text(slot);
  }
  std::string operator()(const FormSlot& form) const {
    return (form.many ? "a list of the forms " : "a form: ") + joined(form.accepted);
  }
};

struct IsUsed {
  bool operator()(const FormSlot& form) const {
    // A slot of forms is used when one of its accepted forms has a slot that is used.
    return std::any_of(form.accepted.begin(), form.accepted.end(), [](std::string_view name) {
      const FormSchema* accepted = find_form(name).schema;
      return accepted != nullptr && std::any_of(accepted->slots.begin(), accepted->slots.end(), is_used);
    });
  }
  bool operator()(const ChoiceSlot& choice) const { return choice.set != nullptr; }
  bool operator()(const PairSlot& pair) const { return pair.first != nullptr; }
  bool operator()(const SpanSlot& span) const { return span.low != nullptr; }
  bool operator()(const auto& simple) const { return simple.of != nullptr; }
};

}  // namespace

const std::vector<FormSchema>& schema() {
  static const std::vector<FormSchema> forms = all_forms();
  return forms;
}

Found<FormSchema> find_form(std::string_view name) {
  return find_named(schema(), name);
}

Found<SlotSchema> find_slot(const FormSchema& form, std::string_view name) {
  return find_named(form.slots, name);
}

namespace {

template <class Schema>
std::string nearest_of(const std::vector<Schema>& rows, std::string_view name) {
  std::vector<std::string> names;
  names.reserve(rows.size());
  for (const Schema& row : rows) names.emplace_back(row.name);
  return text::nearest_word(name, names).value_or("");
}

}  // namespace

std::string nearest_slot(const FormSchema& form, std::string_view name) {
  return nearest_of(form.slots, name);
}

std::string nearest_form(std::string_view name) {
  return nearest_of(schema(), name);
}

std::string_view form_with_slot(std::string_view name) {
  for (const FormSchema& form : schema())
    for (const SlotSchema& slot : form.slots)
      if (slot.name == name) return form.name;
  return {};
}

bool is_used(const SlotSchema& slot) {
  return std::visit(IsUsed{}, slot.binding);
}

std::optional<ConstraintViolation> check_entry(geo::GeoPoint position, std::size_t count, int most,
                                               std::string_view entries) {
  if (count < static_cast<std::size_t>(most)) return check_coordinates(position);
  return ConstraintViolation{"latitude", "at most " + std::to_string(most) + " " + std::string(entries), "one more"};
}

std::optional<ConstraintViolation> check_coordinates(geo::GeoPoint position) {
  if (std::isnan(position.latitude_deg)) return ConstraintViolation{"latitude", "a latitude", "none"};
  if (std::isnan(position.longitude_deg)) return ConstraintViolation{"longitude", "a longitude", "none"};
  return std::nullopt;
}

namespace {

// A text that lives as long as the table of forms.
std::string_view kept(std::string text) {
  static std::deque<std::string> texts;
  return texts.emplace_back(std::move(text));
}

}  // namespace

std::string_view plural(const values::List& list) {
  return kept(std::string(list.entry) + 's');
}

std::string_view purpose_of(const values::List& list) {
  return kept("the " + std::string(plural(list)));
}

std::string_view slot_name(const values::Field& field) {
  std::string name;
  bool begins_word = false;
  for (const char letter : field.label) {
    if (letter != ' ') name += begins_word ? upper(letter) : letter;
    begins_word = letter == ' ';
  }
  return kept(name);
}

SlotSchema more_slot(std::string_view slot, const values::List& list) {
  std::string name = "more" + std::string(slot);
  name[4] = upper(name[4]);
  return more_slot(kept(name), list.form, slot, kept(std::string(plural(list)) + " beside those of earlier forms"));
}

std::string_view replaced_list(int most, std::string_view entries) {
  return kept("at most " + std::to_string(most) + " " + std::string(entries) + "; they replace those of earlier forms");
}

SlotSchema value_slot(std::string_view name, const values::Field& field, double& (*of)(ConfigurationBuilder&)) {
  SlotSchema slot = number_slot(name, field.unit, field.low, field.high, {of, field.factor}, field.purpose);
  if (!field.otherwise.empty())
    slot.purpose = kept(std::string(field.purpose) + "; left out: " + std::string(field.otherwise));
  return slot;
}

SlotSchema entry_slot(std::string_view name, const values::Field& field, double& (*of)(ConfigurationBuilder&)) {
  SlotSchema slot = value_slot(name, field, of);
  if (!std::isnan(field.initial))
    slot.purpose = kept(std::string(field.purpose) + "; left out: " + number_text(field.initial));
  return slot;
}

SlotSchema latitude_slot(double& (*of)(ConfigurationBuilder&)) {
  SlotSchema slot = value_slot("latitude", values::WorldPoint::latitude, nullptr);
  slot.binding = AngleSlot{of, true};
  return slot;
}

SlotSchema longitude_slot(double& (*of)(ConfigurationBuilder&)) {
  SlotSchema slot = value_slot("longitude", values::WorldPoint::longitude, nullptr);
  slot.binding = AngleSlot{of, false};
  return slot;
}

std::string value_kind(const SlotSchema& slot) {
  return std::visit(KindText{slot}, slot.binding);
}

}  // namespace yars::config
