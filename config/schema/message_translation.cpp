#include "config/schema/message_translation.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include "config/guf/messages.hpp"
#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"

namespace yars::config {

namespace {

constexpr std::string_view kAnyOwner = "*";  // inside any form, or outside all braces
constexpr std::string_view kOutermost;       // empty: outside all braces

// Keywords that have another name in GUF. All other keywords have the same name there.
// Source: sample in section 4.3.1 of the 1996 report; forms of its tables 4 to 26.
struct Row {
  std::string_view keyword;
  std::string_view owner;  // GUF name of the form that contains the keyword, or one of the constants above
  std::string_view guf_name;
};

constexpr std::array kForms{Row{"Radar", kAnyOwner, "System"},
                            Row{"MgDmaDatabase", kAnyOwner, "DedDbase"},  // elevations of the Defense Mapping Agency
                            Row{"Display", kOutermost, "Window"},
                            Row{"Display", "System", "Window"},
                            Row{"Display", "Apg70", "Window"},
                            Row{"Display", "RealBeamMode", "RbmDisplay"},
                            Row{"Display", "SarMode", "SarDisplay"},
                            Row{"Antenna", kOutermost, "AntennaServo"},
                            Row{"Antenna", "System", "AntennaServo"},
                            Row{"Antenna", "Apg70", "AntennaServo"},
                            Row{"Antenna", kAnyOwner, "RbmAntenna"}};

constexpr std::array kSlots{Row{"samplesPerSweep", kAnyOwner, "samples"}, Row{"mode", "Window", "bmode"}};

// The GUF name of a keyword inside the form `owner`, by the first row that fits; empty: no row fits.
template <std::size_t count>
std::string_view renamed_keyword(const std::array<Row, count>& rows, std::string_view keyword, std::string_view owner) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& one) {
    return one.keyword == keyword && (one.owner == owner || one.owner == kAnyOwner);
  });
  return row == rows.end() ? std::string_view() : row->guf_name;
}

// Name of the GUF form for `keyword: { ... }` inside the form `owner`; empty: the keyword names no form of GUF. For
// example `Display` is Window in the form System, and RbmDisplay in RealBeamMode. An empty `owner` means outside all
// braces.
std::string_view form_of_keyword(std::string_view keyword, std::string_view owner) {
  const std::string_view renamed = renamed_keyword(kForms, keyword, owner);
  if (!renamed.empty()) return renamed;
  const auto form = find_form(keyword);
  return form.schema != nullptr && form.schema->name == keyword ? form.schema->name : std::string_view();
}

// The name of the slot of `owner` that a keyword sets.
std::string_view slot_of_keyword(std::string_view keyword, std::string_view owner) {
  const std::string_view renamed = renamed_keyword(kSlots, keyword, owner);
  return renamed.empty() ? keyword : renamed;
}

// A keyword of a form can be a slot of an inner form: scanBars of RealBeamMode is a slot of its RbmAntenna.
struct InnerForm {
  std::string_view slot;  // slot of `owner` whose value is the inner form; empty: there is no inner form
  std::string_view form;  // name of the inner form
};
InnerForm inner_form_of_keyword(std::string_view keyword, std::string_view owner) {
  if (keyword == "scanBars" && owner == "RealBeamMode") return {"antenna", "RbmAntenna"};
  return {};
}

using Slots = std::vector<Slot>;

// The arguments in braces; null for any other value.
Slots* arguments_in_braces(Value& value) {
  auto* form = std::get_if<Form>(&value.data);
  return form != nullptr && form->name == kBraces ? &form->slots : nullptr;
}

bool is_value_alone(const Slot& argument) {
  return argument.name.empty();
}

std::string described(const Slot& argument) {
  if (argument.name == kInstance) return "a name with :=";
  if (!argument.name.empty()) return argument.name + ":";
  const auto* form = std::get_if<Form>(&argument.value.data);
  return form != nullptr && form->name == kBraces ? "values in braces" : description(argument.value);
}

// Throws if the same braces contain messages and also values without a keyword. Such a value would have no slot.
void reject_mixture(const Slots& arguments) {
  const auto value = std::find_if(arguments.begin(), arguments.end(), is_value_alone);
  const auto message = std::find_if_not(arguments.begin(), arguments.end(), is_value_alone);
  if (value == arguments.end() || message == arguments.end()) return;
  reject(value->where, "messages alone or values alone in these braces", described(*value), "give it a keyword");
}

// Throws for `Display { ... }` without a colon, as in the text of the 1996 report. The parser reads an identifier and
// braces, which are two values.
void reject_missing_colon(const Slots& arguments) {
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
    const auto* word = std::get_if<Identifier>(&arguments[i].value.data);
    const auto* next = std::get_if<Form>(&arguments[i + 1].value.data);
    if (word == nullptr || !is_value_alone(arguments[i]) || !is_value_alone(arguments[i + 1])) continue;
    if (next != nullptr && next->name == kBraces) {
      reject(arguments[i].where, word->name + ": { ... }", word->name + " { ... }", "put a colon after the keyword");
    }
  }
}

// Throws for an unknown keyword that is a reserved word of GUF. The translation keeps unknown keywords, and in GUF a
// reserved word has another meaning.
void reject_word_of_guf(const Slot& message) {
  constexpr std::array<std::string_view, 7> kWords{"include", "guf", "def-form", "true", "false", "TRUE", "FALSE"};
  if (std::find(kWords.begin(), kWords.end(), message.name) == kWords.end()) return;
  reject(message.where, "a keyword of the radar", message.name + ":",
         "this is a reserved word of GUF; choose another keyword");
}

// The slot of `owner` that accepts the form; null: none.
const SlotSchema* slot_for_form(const FormSchema& owner, std::string_view form) {
  for (const SlotSchema& slot : owner.slots) {
    const auto* kind = std::get_if<FormSlot>(&slot.binding);
    if (kind == nullptr) continue;
    if (std::find(kind->accepted.begin(), kind->accepted.end(), form) != kind->accepted.end()) return &slot;
  }
  return nullptr;
}

Slot* named(Slots& slots, std::string_view name) {
  const auto found = std::find_if(slots.begin(), slots.end(), [&](const Slot& slot) { return slot.name == name; });
  return found == slots.end() ? nullptr : &*found;
}

// Translates messages to forms. Calls that can throw are not made inside a braced initializer, because GCC 12 destroys
// a partly constructed aggregate twice when an element throws.
class Translator {
  using SlotIndices = std::map<std::string_view, std::size_t>;  // name of a slot with forms -> its index in the result

 public:
  explicit Translator(std::vector<std::string>& warnings) : warnings_(warnings) {}

  Slots outermost(Slots arguments) {
    reject_missing_colon(arguments);
    Slots forms;
    for (Slot& argument : arguments) {
      if (take_instance(argument)) continue;
      reject_include(argument.value);
      if (is_value_alone(argument) || arguments_in_braces(argument.value) == nullptr) {
        reject(argument.where, "a message that makes a form, as Radar: { ... }", described(argument));
      }
      Value form = form_of(argument, "");
      forms.push_back({"", 0, argument.where, std::move(form)});
    }
    return forms;
  }

 private:
  // The form of a message. A form that GUF lacks has the keyword as its name; FormReader later warns about that form.
  Value form_of(Slot& message, std::string_view owner) {
    const std::string_view name = form_of_keyword(message.name, owner);
    Slots* arguments = arguments_in_braces(message.value);
    if (arguments == nullptr) {
      reject(message.value.where, "{ ... } after " + message.name + ":", description(message.value));
    }
    const auto instance = std::exchange(instance_, {});
    if (name.empty()) reject_word_of_guf(message);
    Slots slots = name.empty() ? unknown_slots(*arguments) : slots_of(*find_form(name).schema, *arguments);
    const bool radar = name == "System" || name == "Apg70";
    if (radar && !instance.name.empty() && named(slots, "name") == nullptr) {
      slots.push_back({"name", 0, instance.where, {instance.where, instance.name}});
    } else {
      warn_unused(instance);
    }
    return {message.where, Form{name.empty() ? message.name : std::string(name), std::move(slots)}};
  }

  Slots slots_of(const FormSchema& owner, Slots& arguments) {
    reject_missing_colon(arguments);
    reject_mixture(arguments);
    Slots slots;
    SlotIndices form_slots;
    Slots inner;  // keywords that are slots of an inner form
    for (Slot& argument : arguments) {
      if (take_instance(argument)) continue;
      if (!is_value_alone(argument) && !form_of_keyword(argument.name, owner.name).empty()) {
        add_form(slots, form_slots, owner, argument);
      } else if (!inner_form_of_keyword(argument.name, owner.name).slot.empty()) {
        inner.push_back(std::move(argument));
      } else {
        slots.push_back(slot_of(owner, argument));
      }
      warn_unused(std::exchange(instance_, {}));
    }
    for (Slot& argument : inner) add_to_inner_form(slots, form_slots, owner, argument);
    return slots;
  }

  // Puts the form of a message such as `Antenna: { ... }` into the slot that accepts this form. A slot for several
  // forms gets a list.
  void add_form(Slots& slots, SlotIndices& form_slots, const FormSchema& owner, Slot& message) {
    const SlotSchema* slot = slot_for_form(owner, form_of_keyword(message.name, owner.name));
    if (slot == nullptr) {
      reject(message.where, "a message that is allowed in " + std::string(owner.name), message.name + ":");
    }
    const bool many = std::get<FormSlot>(slot->binding).many;
    Value form = form_of(message, owner.name);
    const auto [index, first] = form_slots.emplace(slot->name, slots.size());
    if (many && !first) {
      std::get<List>(slots[index->second].value.data).items.push_back(std::move(form));
      return;
    }
    if (many) form = {message.where, List{{std::move(form)}}};
    slots.push_back({std::string(slot->name), 0, message.where, std::move(form)});
  }

  void add_to_inner_form(Slots& slots, SlotIndices& form_slots, const FormSchema& owner, Slot& message) {
    const InnerForm inner = inner_form_of_keyword(message.name, owner.name);
    const auto [index, first] = form_slots.emplace(inner.slot, slots.size());
    if (first) {
      slots.push_back({std::string(inner.slot), 0, message.where, {message.where, Form{std::string(inner.form), {}}}});
    }
    Slot slot = slot_of(*find_form(inner.form).schema, message);
    std::get<Form>(slots[index->second].value.data).slots.push_back(std::move(slot));
  }

  Slot slot_of(const FormSchema& owner, Slot& argument) {
    const std::string name(slot_of_keyword(argument.name, owner.name));
    const SlotSchema* slot = name.empty() ? nullptr : find_slot(owner, name).schema;
    if (slot == nullptr && !name.empty()) return unknown_slot(argument);
    const auto* forms = slot == nullptr ? nullptr : std::get_if<FormSlot>(&slot->binding);
    Value value = forms == nullptr ? value_without_forms(argument.value) : forms_of_slot(owner, *forms, argument);
    return {name, 0, argument.where, std::move(value)};
  }

  // The value of a slot that contains forms, such as `modes: { modeOne := RealBeamMode: { ... } }`.
  Value forms_of_slot(const FormSchema& owner, const FormSlot& kind, Slot& argument) {
    Slots* arguments = arguments_in_braces(argument.value);
    if (arguments == nullptr) return std::move(argument.value);
    List forms;
    for (Slot& item : *arguments) {
      if (take_instance(item)) continue;
      reject_include(item.value);
      if (is_value_alone(item))
        reject(item.where, "messages that make forms in " + argument.name + ":", described(item));
      forms.items.push_back(form_of(item, owner.name));
    }
    if (!kind.many && forms.items.size() == 1) return std::move(forms.items.front());
    return {argument.value.where, std::move(forms)};
  }

  // Translates a value without forms: braces become a list, any other value is unchanged.
  Value value_without_forms(Value& value) {
    reject_include(value);
    Slots* arguments = arguments_in_braces(value);
    if (arguments == nullptr) return std::move(value);
    List list;
    for (Slot& argument : *arguments) {
      if (!is_value_alone(argument)) reject(argument.where, "values, as { 1, 2 }", described(argument));
      list.items.push_back(value_without_forms(argument.value));
    }
    return {value.where, std::move(list)};
  }

  // The slots of an unknown form.
  Slots unknown_slots(Slots& arguments) {
    reject_mixture(arguments);
    Slots slots;
    for (Slot& argument : arguments) {
      if (argument.name != kInstance) slots.push_back(unknown_slot(argument));
    }
    return slots;
  }

  // A slot that the schema lacks. It keeps its keyword, and messages in its braces become a form.
  Slot unknown_slot(Slot& argument) {
    Slots* arguments = arguments_in_braces(argument.value);
    const bool messages = arguments != nullptr && !arguments->empty() && !is_value_alone(arguments->front());
    if (messages) reject_word_of_guf(argument);
    Slots slots = messages ? unknown_slots(*arguments) : Slots();
    Value value =
        messages ? Value{argument.where, Form{argument.name, std::move(slots)}} : value_without_forms(argument.value);
    return {argument.name, 0, argument.where, std::move(value)};
  }

  // Stores the name of `name :=`, which belongs to the next message. False: the argument is a message or a value.
  bool take_instance(const Slot& argument) {
    if (argument.name != kInstance) return false;
    instance_ = {argument.where, std::get<Identifier>(argument.value.data).name};
    return true;
  }

  // Includes in files are replaced before translation. A remaining include is in a text in memory, which has no folder.
  static void reject_include(const Value& value) {
    const auto* form = std::get_if<Form>(&value.data);
    if (form != nullptr && form->name == "include")
      reject(value.where, "#include in files only", "it in a text without a file");
  }

  struct Instance {
    Location where;
    std::string name;
  };

  void warn_unused(const Instance& instance) {
    if (instance.name.empty() || warnings_.size() >= kMaxWarnings) return;
    warnings_.push_back(text_of(instance.where) + ": the name " + instance.name + " is read, not used");
  }

  std::vector<std::string>& warnings_;
  Instance instance_;  // name for the next message
};

}  // namespace

ParsedText guf_from_messages(ParsedText messages) {
  if (!messages.arguments.empty() && messages.warnings.size() < kMaxWarnings) {
    messages.warnings.push_back(text_of(messages.arguments.front().where) +
                                ": messages are the syntax of 1996; `yars config convert` writes them as GUF");
  }
  messages.arguments = Translator(messages.warnings).outermost(std::move(messages.arguments));
  return messages;
}

}  // namespace yars::config
