#include "config/schema/slot_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>

#include "config/guf/tree.hpp"
#include "config/schema/schema.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/devices.hpp"

namespace yars::config {

namespace {

constexpr const char* kManual = "`yars config print --defaults` explains every slot";

// Validates one value and writes it into the field of its slot. One operator() for each kind of slot.
class Reader {
 public:
  Reader(ConfigurationBuilder& builder, const SlotSchema& slot, const Value& value)
      : builder_(builder), slot_(slot), value_(value) {}

  void operator()(const NumberSlot& kind) const {
    const double number = in_range(value_);
    if (kind.of) kind.of(builder_) = number * kind.si_per_unit;
  }
  void operator()(const IntegerSlot& kind) const {
    const double number = whole(value_);
    if (kind.of) kind.of(builder_) = static_cast<int>(number);
  }
  void operator()(const CounterSlot& kind) const {
    const double number = whole(value_);
    if (kind.of) kind.of(builder_) = static_cast<std::uint64_t>(number);
  }
  void operator()(const BooleanSlot& kind) const {
    const auto* flag = std::get_if<bool>(&value_.data);
    if (flag == nullptr) wrong(value_);
    if (kind.of) kind.of(builder_) = *flag;
  }
  void operator()(const TextSlot& kind) const {
    const std::string& text = string();
    if (kind.of) kind.of(builder_) = text;
  }
  void operator()(const PathSlot& kind) const {
    const std::filesystem::path path = string();
    if (kind.of == nullptr) return;
    const bool unchanged = path.empty() || path.is_absolute();
    const auto folder = value_.where.file ? std::filesystem::path(*value_.where.file).parent_path() : path;
    kind.of(builder_) = (unchanged ? path : (folder / path).lexically_normal()).string();
  }
  void operator()(const AngleSlot& kind) const {
    const double degrees = in_range(value_);
    if (kind.of) kind.of(builder_) = degrees;
  }
  void operator()(const ChoiceSlot& kind) const {
    const std::string word = chosen_word();
    const auto found = std::find(kind.words.begin(), kind.words.end(), word);
    if (found == kind.words.end()) wrong(value_);
    if (kind.set) kind.set(builder_, static_cast<int>(found - kind.words.begin()));
  }
  void operator()(const ListSlot& kind) const {
    std::vector<double> numbers = list(kind.min_count, kind.max_count);
    const bool descending = kind.order == Order::descending;
    for (std::size_t i = 1; i < numbers.size() && kind.order != Order::any; ++i) {
      if (descending ? numbers[i] >= numbers[i - 1] : numbers[i] <= numbers[i - 1]) {
        const Value& item = std::get<List>(value_.data).items[i];
        wrong(item, number_text(numbers[i]) + " after " + number_text(numbers[i - 1]));
      }
    }
    if (kind.of) kind.of(builder_) = std::move(numbers);
  }
  void operator()(const FirstSlot& kind) const {
    constexpr std::size_t kMaxItems = 16;
    const auto* items = std::get_if<List>(&value_.data);
    if (items == nullptr) {
      kind.of(builder_) = static_cast<int>(whole(value_));
      return;
    }
    if (items->items.empty() || items->items.size() > kMaxItems) wrong(value_);
    for (const Value& item : items->items) whole(item);
    kind.of(builder_) = static_cast<int>(whole(items->items.front()));
  }
  void operator()(const PairSlot& kind) const {
    const auto numbers = list(2, 2);
    if (kind.first == nullptr) return;
    kind.first(builder_) = numbers[0];
    kind.second(builder_) = numbers[1];
  }
  void operator()(const SpanSlot& kind) const {
    const auto [low, high] = span(kind.centred);
    if (low >= high) wrong(value_, number_text(low) + " and " + number_text(high));
    if (kind.low == nullptr) return;
    kind.low(builder_) = low;
    kind.high(builder_) = high;
  }
  void operator()(const SymmetricSlot& kind) const {
    const auto* items = std::get_if<List>(&value_.data);
    if (items == nullptr || items->items.size() != 2) wrong(value_);
    const double low = number(items->items[0]);
    const double high = in_range(items->items[1]);
    if (low != -high) wrong(items->items[0], number_text(low) + " and " + number_text(high));
    if (kind.of) kind.of(builder_) = high;
  }
  void operator()(const FormSlot&) const {
    error::requirement_broken("a slot of forms is read by FormReader", slot_.name, __FILE__, __LINE__);
  }

 private:
  [[noreturn]] void wrong(const Value& value, std::string found = {}) const {
    if (found.empty()) found = description(value);
    reject(value.where, value_kind(slot_) + " for :" + std::string(slot_.name), std::move(found), kManual);
  }

  double number(const Value& value) const {
    const auto* number = std::get_if<double>(&value.data);
    if (number == nullptr) wrong(value);
    return *number;
  }

  double in_range(const Value& value) const {
    const double found = number(value);
    if (!(found >= slot_.lowest && found <= slot_.highest)) wrong(value);
    return found;
  }

  double whole(const Value& value) const {
    const double found = in_range(value);
    if (found != std::floor(found)) wrong(value);
    return found;
  }

  const std::string& string() const {
    const auto* text = std::get_if<std::string>(&value_.data);
    if (text == nullptr) wrong(value_);
    return *text;
  }

  // The text of a choice, which can be written as a number, an identifier or a string: `1996`, `draft`, "draft".
  std::string chosen_word() const {
    if (const auto* identifier = std::get_if<Identifier>(&value_.data)) return identifier->name;
    if (const auto* number = std::get_if<double>(&value_.data)) return number_text(*number);
    return string();
  }

  std::vector<double> list(std::size_t min_count, std::size_t max_count) const {
    const auto* items = std::get_if<List>(&value_.data);
    if (items == nullptr || items->items.size() < min_count || items->items.size() > max_count) wrong(value_);
    std::vector<double> numbers;
    for (const Value& item : items->items) numbers.push_back(in_range(item));
    return numbers;
  }

  std::pair<double, double> span(bool centred) const {
    if (std::holds_alternative<double>(value_.data)) {
      const double whole_span = in_range(value_);
      return centred ? std::pair(-whole_span / 2, whole_span / 2) : std::pair(0.0, whole_span);
    }
    const auto numbers = list(2, 2);
    return {numbers[0], numbers[1]};
  }

  ConfigurationBuilder& builder_;
  const SlotSchema& slot_;
  const Value& value_;
};

}  // namespace

void read_simple(ConfigurationBuilder& builder, const SlotSchema& slot, const Value& value) {
  std::visit(Reader(builder, slot, value), slot.binding);
}

void read_sexagesimal(ConfigurationBuilder& builder, const SlotSchema& slot, const Location& where) {
  const auto& kind = std::get<AngleSlot>(slot.binding);
  const SexagesimalAngle& angle = builder.angle;
  const bool north_south = angle.direction < 2;
  if (north_south != kind.latitude) {
    reject(where, kind.latitude ? "N or S for a latitude" : "E or W for a longitude",
           north_south ? "N or S" : "E or W");
  }
  const double size_deg = angle.degrees + angle.minutes / 60.0 + angle.seconds / 3600.0;
  const bool negative = angle.direction % 2 == 1;
  read_simple(builder, slot, {where, negative ? -size_deg : size_deg});
}

namespace {

// Converts `si` to the unit of a slot: the number whose product with si_per_unit is exactly `si`. Rounding can make the
// quotient si / si_per_unit the next smaller or next greater double. The function therefore tries the quotient and both
// neighbours. If none of them gives `si`, it returns the quotient.
double in_units(double si, double si_per_unit) {
  const double quotient = si / si_per_unit;
  for (const double candidate : {quotient, std::nextafter(quotient, -1e308), std::nextafter(quotient, 1e308)}) {
    if (candidate * si_per_unit == si) return candidate;
  }
  return quotient;
}

std::string list_text(const std::vector<double>& numbers) {
  std::string text = "`( ";
  for (const double number : numbers) text += number_text(number) + " ";
  return text + ")";
}

// The value of a slot as GUF text. One operator() for each kind of slot.
struct Writer {
  ConfigurationBuilder& builder;

  std::string operator()(const NumberSlot& kind) const {
    if (kind.of == nullptr) return {};
    const double value = kind.of(builder);
    return std::isnan(value) ? std::string() : number_text(in_units(value, kind.si_per_unit));
  }
  std::string operator()(const IntegerSlot& kind) const { return kind.of ? std::to_string(kind.of(builder)) : ""; }
  std::string operator()(const CounterSlot& kind) const { return kind.of ? std::to_string(kind.of(builder)) : ""; }
  std::string operator()(const BooleanSlot& kind) const {
    if (kind.of == nullptr) return {};
    return kind.of(builder) ? "true" : "false";
  }
  std::string operator()(const TextSlot& kind) const { return kind.of ? quoted_text(kind.of(builder)) : ""; }
  std::string operator()(const PathSlot& kind) const { return kind.of ? quoted_text(kind.of(builder)) : ""; }
  std::string operator()(const AngleSlot& kind) const {
    return kind.of == nullptr || std::isnan(kind.of(builder)) ? std::string() : number_text(kind.of(builder));
  }
  std::string operator()(const ChoiceSlot& kind) const {
    const int index = kind.get ? kind.get(builder) : -1;
    return index < 0 ? std::string() : std::string(kind.words[static_cast<std::size_t>(index)]);
  }
  std::string operator()(const ListSlot& kind) const { return kind.of ? list_text(kind.of(builder)) : ""; }
  std::string operator()(const FirstSlot& kind) const { return std::to_string(kind.of(builder)); }
  std::string operator()(const PairSlot& kind) const {
    return kind.first ? list_text({kind.first(builder), kind.second(builder)}) : "";
  }
  std::string operator()(const SpanSlot& kind) const {
    return kind.low ? list_text({kind.low(builder), kind.high(builder)}) : "";
  }
  std::string operator()(const SymmetricSlot& kind) const {
    return kind.of ? list_text({-kind.of(builder), kind.of(builder)}) : "";
  }
  std::string operator()(const FormSlot&) const { return {}; }
};

}  // namespace

std::string slot_text(ConfigurationBuilder& builder, const SlotSchema& slot) {
  return std::visit(Writer{builder}, slot.binding);
}

namespace {

// Remark for the manual: the slot has the same effect as another slot, or is not used. Empty: no remark applies.
std::string use_of(const FormSchema& form, const SlotSchema& slot) {
  if (!slot.same_as.empty()) return "; the same as " + std::string(slot.same_as);
  return is_used(slot) || form.part_of_value ? "" : "; read, not used";
}

// Default of a slot as text. Empty: the slot contains forms, is unused, has an unknown default (NaN), or its form is
// part_of_value (schema.hpp).
std::string default_text(const FormSchema& form, const SlotSchema& slot) {
  return form.part_of_value ? std::string() : slot_text(*new_builder(), slot);
}

std::string explanation(const FormSchema& form, std::size_t index) {
  const SlotSchema& slot = form.slots[index];
  const std::string default_value = default_text(form, slot);
  return std::string(":").append(slot.name) + " (" + std::to_string(index + 1) + ") " + value_kind(slot) +
         (default_value.empty() ? "" : ", default " + default_value) + ": " + std::string(slot.purpose) +
         use_of(form, slot);
}

std::string heading(const FormSchema& form) {
  const std::string base = form.base.empty() ? std::string() : ", is= " + std::string(form.base);
  return std::string(form.name) + base + ": " + std::string(form.purpose);
}

// Prints the forms of a configuration as GUF text.
class Printer {
 public:
  Printer(BuilderPointer builder, bool explained) : builder_(std::move(builder)), explained_(explained) {}

  std::string print(std::string_view outermost = "Apg70") {
    write_form(*find_form(outermost).schema, 0);
    return std::move(text_);
  }
  const std::set<std::string_view>& written() const { return written_; }

 private:
  void line(int depth, const std::string& text) { text_ += std::string(std::size_t(depth) * 2, ' ') + text + "\n"; }

  void write_form(const FormSchema& form, int depth) {
    written_.insert(form.name);
    if (explained_) line(depth, "; " + heading(form));
    line(depth, std::string("( ").append(form.name));
    for (std::size_t i = 0; i < form.slots.size(); ++i) write_slot(form, i, depth + 1);
    line(depth, ")");
  }

  void write_slot(const FormSchema& form, std::size_t index, int depth) {
    const SlotSchema& slot = form.slots[index];
    if (explained_) line(depth, "; " + explanation(form, index));
    if (!slot.same_as.empty()) return;
    if (const auto* forms = std::get_if<FormSlot>(&slot.binding)) {
      write_forms(slot, *forms, depth);
      return;
    }
    const std::string value = slot_text(*builder_, slot);
    if (!value.empty()) line(depth, std::string(":").append(slot.name) + " " + value);
  }

  void write_forms(const SlotSchema& slot, const FormSlot& forms, int depth) {
    if (forms.printed.empty()) return;
    line(depth, std::string(":").append(slot.name) + (forms.many ? " `(" : ""));
    if (forms.load) forms.load(*builder_);
    for (const std::string_view name : forms.printed) {
      const FormSchema& form = *find_form(name).schema;
      const std::size_t count = form.count ? form.count(*builder_) : 1;
      for (std::size_t i = 0; i < count; ++i) {
        if (form.select) form.select(*builder_, i);
        write_form(form, depth + 1);
      }
    }
    if (forms.many) line(depth, ")");
  }

  BuilderPointer builder_;
  bool explained_;
  std::string text_;
  std::set<std::string_view> written_;
};

}  // namespace

std::string print_configuration(const radar::RadarConfiguration& configuration) {
  return Printer(builder_of(configuration), false).print();
}

std::string print_explained(const radar::RadarConfiguration& configuration) {
  Printer printer(builder_of(configuration), true);
  std::string text = "; A slot is given by name, or by the position in parentheses.\n\n" + printer.print();
  text += "\n; Further forms.\n";
  for (const FormSchema& form : schema()) {
    if (printer.written().contains(form.name)) continue;
    text += ";\n; " + heading(form) + "\n";
    for (std::size_t i = 0; i < form.slots.size(); ++i) text += ";   " + explanation(form, i) + "\n";
  }
  return text;
}

std::string print_devices(const std::vector<radar::Device>& devices) {
  const BuilderPointer builder = new_builder();
  builder->radar.devices = devices;
  return Printer(builder, false).print("Devices");
}

namespace {

// Forms that the manual describes on one page.
struct FormGroup {
  std::string_view name;
  std::vector<std::string_view> forms;
};

const std::vector<FormGroup>& groups() {
  static const std::vector<FormGroup> table{
      {"radar", {"System", "Apg70"}},
      {"antenna", {"AntennaServo", "RbmAntenna", "Receiver", "Noise"}},
      {"modes",
       {"Mode", "OffMode", "StbyMode", "RealBeamMode", "SarMode", "HighResolution", "WindowLimits", "HeightRanges"}},
      {"display", {"Window", "ColorScheme", "Display", "RbmDisplay", "SarDisplay", "MgDisplay"}},
      {"terrain", {"Terrain", "Database", "DedDbase", "MgDbase"}},
      {"world",
       {"Land", "Materials", "Material", "Sea", "Rain", "RainCell", "Atmosphere", "Jammers", "Jammer", "Movers",
        "Mover", "Beacons", "Beacon", "Scenes", "Scene"}},
      {"route", {"Route", "Point", "Navigation"}},
      {"devices", {"Devices", "Device", "Button", "Axis"}},
      {"fidelity", {"Fidelity"}},
      {"values", {"rgb", "rgba", "hsv", "hsva", "lat-long"}}};
  return table;
}

// Heading and table of one form, in Markdown.
std::string form_table(const FormSchema& form) {
  std::string text = "## " + std::string(form.name) + "\n\n" + heading(form) +
                     ".\n\n| position | slot | value | default | for |\n| --- | --- | --- | --- | --- |\n";
  for (std::size_t i = 0; i < form.slots.size(); ++i) {
    const SlotSchema& slot = form.slots[i];
    const std::string default_value = default_text(form, slot);
    text += "| " + std::to_string(i + 1) + " | `" + std::string(slot.name) + "` | " + value_kind(slot) + " | " +
            (default_value.empty() ? "" : "`` " + default_value + " ``") + " | " + std::string(slot.purpose) +
            use_of(form, slot) + " |\n";
  }
  return text + "\n";
}

}  // namespace

std::vector<std::string> form_groups() {
  std::vector<std::string> names;
  for (const FormGroup& group : groups()) names.emplace_back(group.name);
  return names;
}

std::string print_markdown(std::string_view group) {
  std::string text;
  const auto found = std::ranges::find(groups(), group, &FormGroup::name);
  if (found == groups().end()) return text;
  for (const std::string_view form : found->forms) text += form_table(*find_form(form).schema);
  return text;
}

}  // namespace yars::config
