#include "config/print.hpp"

#include <algorithm>
#include <set>

#include "config/schema.hpp"
#include "config/slot_text.hpp"

namespace yars::config {
namespace {

// What print leaves out, and why.
std::string use_of(const FormSchema& form, const SlotSchema& slot) {
  if (!slot.same_as.empty()) return "; the same as " + std::string(slot.same_as);
  return is_used(slot) || form.part_of_value ? "" : "; read, not used";
}

// Empty where a slot has no default: it holds forms, belongs to one of many, or nothing uses it.
std::string default_text(const FormSchema& form, const SlotSchema& slot) {
  Draft defaults;
  return form.part_of_value ? std::string() : slot_text(defaults, slot);
}

std::string explanation(const FormSchema& form, std::size_t index) {
  const SlotSchema& slot = form.slots[index];
  const std::string usual = default_text(form, slot);
  return std::string(":").append(slot.name) + " (" + std::to_string(index + 1) + ") " + value_kind(slot) +
         (usual.empty() ? "" : ", default " + usual) + ": " + std::string(slot.purpose) + use_of(form, slot);
}

std::string heading(const FormSchema& form) {
  const std::string base = form.base.empty() ? std::string() : ", is= " + std::string(form.base);
  return std::string(form.name) + base + ": " + std::string(form.purpose);
}

// Writes one tree of forms.
class Printer {
 public:
  Printer(const radar::RadarConfiguration& configuration, bool explained)
      : draft_(draft_of(configuration)), explained_(explained) {}

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
    const std::string value = slot_text(draft_, slot);
    if (!value.empty()) line(depth, std::string(":").append(slot.name) + " " + value);
  }

  void write_forms(const SlotSchema& slot, const FormSlot& forms, int depth) {
    if (forms.printed.empty()) return;
    line(depth, std::string(":").append(slot.name) + (forms.many ? " `(" : ""));
    if (forms.give) forms.give(draft_);
    for (const std::string_view name : forms.printed) {
      const FormSchema& form = *find_form(name).schema;
      const std::size_t count = form.count ? form.count(draft_) : 1;
      for (std::size_t i = 0; i < count; ++i) {
        if (form.select) form.select(draft_, i);
        write_form(form, depth + 1);
      }
    }
    if (forms.many) line(depth, ")");
  }

  Draft draft_;
  bool explained_;
  std::string text_;
  std::set<std::string_view> written_;
};

}  // namespace

std::string print_configuration(const radar::RadarConfiguration& configuration) {
  return Printer(configuration, false).print();
}

std::string print_explained(const radar::RadarConfiguration& configuration) {
  Printer printer(configuration, true);
  std::string text = "; A slot is given by name, or by the position in parentheses.\n\n" + printer.print();
  text += "\n; Further forms.\n";
  for (const FormSchema& form : schema()) {
    if (printer.written().contains(form.name)) continue;
    text += ";\n; " + heading(form) + "\n";
    for (std::size_t i = 0; i < form.slots.size(); ++i) text += ";   " + explanation(form, i) + "\n";
  }
  return text;
}

std::string print_devices(const radar::RadarConfiguration& configuration) {
  return Printer(configuration, false).print("Devices");
}

std::string print_markdown() {
  std::string text;
  for (const FormSchema& form : schema()) {
    text +=
        "### " + heading(form) + "\n\n| position | slot | value | default | for |\n| --- | --- | --- | --- | --- |\n";
    for (std::size_t i = 0; i < form.slots.size(); ++i) {
      const SlotSchema& slot = form.slots[i];
      const std::string usual = default_text(form, slot);
      text += "| " + std::to_string(i + 1) + " | `" + std::string(slot.name) + "` | " + value_kind(slot) + " | " +
              (usual.empty() ? "" : "`` " + usual + " ``") + " | " + std::string(slot.purpose) + use_of(form, slot) +
              " |\n";
    }
    text += "\n";
  }
  return text;
}

}  // namespace yars::config
