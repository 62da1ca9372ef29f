#include "config/schema/slot_text.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/devices.hpp"
#include "lib/radar/network.hpp"

namespace yars::config {

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
  std::string operator()(const WordsSlot& kind) const {
    if (kind.of == nullptr) return {};
    std::string text = "`( ";
    for (const std::string& word : kind.of(builder)) text += quoted_text(word) + " ";
    return text + ")";
  }
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
  if (is_used(slot) || form.part_of_value) return "";
  return slot.instead.empty() ? "; read, not used" : "; read, not used: " + std::string(slot.instead);
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

// full: every slot. explained: with a comment before each. brief: without slots that have their default, one line for a
// form without forms in it.
enum class PrintStyle { full, explained, brief };

// Prints the forms of a configuration as GUF text.
class Printer {
 public:
  Printer(BuilderPointer builder, PrintStyle style) : builder_(std::move(builder)), style_(style) {}

  std::string print(std::string_view outermost = "Apg70") {
    write_form(*find_form(outermost).schema, 0);
    return std::move(text_);
  }
  const std::set<std::string_view>& written() const { return written_; }

 private:
  void line(int depth, const std::string& text) { text_ += std::string(std::size_t(depth) * 2, ' ') + text + "\n"; }

  void write_form(const FormSchema& form, int depth) {
    written_.insert(form.name);
    if (explained()) line(depth, "; " + heading(form));
    const auto has_forms = [](const SlotSchema& slot) { return std::holds_alternative<FormSlot>(slot.binding); };
    if (style_ == PrintStyle::brief && std::ranges::none_of(form.slots, has_forms)) {
      line(depth, brief_form(form));
      return;
    }
    line(depth, std::string("( ").append(form.name));
    for (std::size_t i = 0; i < form.slots.size(); ++i) write_slot(form, i, depth + 1);
    line(depth, ")");
  }

  std::string brief_form(const FormSchema& form) {
    std::string text = std::string("( ").append(form.name);
    for (const SlotSchema& slot : form.slots) {
      const std::string value = value_text(form, slot);
      if (!value.empty()) text.append(" :").append(slot.name).append(" ").append(value);
    }
    return text + " )";
  }

  // The value of a slot as GUF text; in brief style empty where it is the default of its form.
  std::string value_text(const FormSchema& form, const SlotSchema& slot) {
    const std::string value = slot_text(*builder_, slot);
    // A word says what an axis is for, also where it is the default.
    if (style_ != PrintStyle::brief || !form.begin || std::holds_alternative<ChoiceSlot>(slot.binding)) return value;
    form.begin(*defaults_);
    return value == slot_text(*defaults_, slot) ? std::string() : value;
  }

  void write_slot(const FormSchema& form, std::size_t index, int depth) {
    const SlotSchema& slot = form.slots[index];
    if (explained()) line(depth, "; " + explanation(form, index));
    if (!slot.same_as.empty()) return;
    if (const auto* forms = std::get_if<FormSlot>(&slot.binding)) {
      write_forms(slot, *forms, depth);
      return;
    }
    const std::string value = value_text(form, slot);
    if (!value.empty()) line(depth, std::string(":").append(slot.name) + " " + value);
  }

  void write_forms(const SlotSchema& slot, const FormSlot& forms, int depth) {
    if (forms.printed.empty() || (style_ == PrintStyle::brief && is_empty(forms))) return;
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

  bool is_empty(const FormSlot& forms) {
    return std::ranges::all_of(forms.printed, [this](std::string_view name) {
      const FormSchema& form = *find_form(name).schema;
      return form.count && form.count(*builder_) == 0;
    });
  }

  bool explained() const { return style_ == PrintStyle::explained; }

  BuilderPointer builder_;
  BuilderPointer defaults_ = new_builder();
  PrintStyle style_;
  std::string text_;
  std::set<std::string_view> written_;
};

}  // namespace

std::string print_configuration(const radar::RadarConfiguration& configuration) {
  return Printer(builder_of(configuration), PrintStyle::full).print();
}

std::string print_explained(const radar::RadarConfiguration& configuration) {
  Printer printer(builder_of(configuration), PrintStyle::explained);
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
  return Printer(builder, PrintStyle::brief).print("Devices");
}

std::string print_network(const radar::NetworkSettings& network) {
  const BuilderPointer builder = new_builder();
  builder->network = network;
  return Printer(builder, PrintStyle::full).print("Network");
}

namespace {

// Forms that the manual describes on one page.
struct FormGroup {
  std::string_view name;
  std::vector<std::string_view> forms;
};

std::vector<FormGroup> all_groups() {
  std::vector<FormGroup> table{
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
      {"network", {"Network"}},
      {"fidelity", {"Fidelity"}},
      {"values", {"rgb", "rgba", "hsv", "hsva", "lat-long"}}};
  std::vector<std::string_view>& of_world = std::ranges::find(table, "world", &FormGroup::name)->forms;
  for (const FormSchema& form : list_forms())
    if (std::ranges::find(of_world, form.name) == of_world.end()) of_world.push_back(form.name);
  return table;
}

const std::vector<FormGroup>& groups() {
  static const std::vector<FormGroup> table = all_groups();
  return table;
}

// A default as code in Markdown. A list begins with a backtick itself.
std::string code_span(const std::string& text) {
  if (text.empty()) return text;
  return text.find('`') == std::string::npos ? "`" + text + "`" : "`` " + text + " ``";
}

// Row of one slot in the table of its form, in Markdown.
std::string slot_row(const FormSchema& form, std::size_t index) {
  const SlotSchema& slot = form.slots[index];
  return "| " + std::to_string(index + 1) + " | `" + std::string(slot.name) + "` | " + value_kind(slot) + " | " +
         code_span(default_text(form, slot)) + " | " + std::string(slot.purpose) + use_of(form, slot) + " |\n";
}

// Heading and table of one form, in Markdown. The table leaves out slots that are equal to those of the form's base.
std::string form_table(const FormSchema& form) {
  const FormSchema* const base = form.base.empty() ? nullptr : find_form(form.base).schema;
  std::string rows;
  for (std::size_t i = 0; i < form.slots.size(); ++i) {
    const std::string row = slot_row(form, i);
    const bool is_of_base = base != nullptr && i < base->slots.size() && row == slot_row(*base, i);
    if (!is_of_base) rows += row;
  }
  const std::string text = "## " + std::string(form.name) + "\n" + heading(form) + ".\n\n";
  if (rows.empty()) return text;
  return text + "| position | slot | value | default | for |\n| --- | --- | --- | --- | --- |\n" + rows + "\n";
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
