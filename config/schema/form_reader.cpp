#include "config/schema/form_reader.hpp"

#include <algorithm>
#include <utility>

#include "config/guf/parser.hpp"
#include "config/schema/slot_value.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

namespace {

const std::string& identifier_of(const Value& value, const char* expected) {
  const auto* identifier = std::get_if<Identifier>(&value.data);
  if (identifier == nullptr) reject(value.where, expected, description(value));
  return identifier->name;
}

}  // namespace

void FormDefinitions::define(const Form& form, const Location& where) {
  // Maximum number of forms that a text defines, and of slots that it adds to a form. Without these limits a hostile
  // text could cause very long searches.
  constexpr std::size_t kMaxForms = 1000;
  constexpr std::size_t kMaxSlots = 1000;
  if (form.slots.empty()) reject(where, "( def-form name is= base 'slot ... )", "no name");
  if (definitions_.size() >= kMaxForms) reject(where, "at most 1000 forms defined", "one more");
  Definition definition;
  definition.meaning.defined_in_text = true;
  definition.name = identifier_of(form.slots[0].value, "the name of the new form");
  for (std::size_t i = 1; i < form.slots.size(); ++i) {
    const Slot& slot = form.slots[i];
    if (slot.name == "is=") {
      const std::string& base = identifier_of(slot.value, "the name of a form");
      KnownForm known = find(base);
      if (known.schema == nullptr && !known.defined_in_text) {
        reject(slot.value.where, "a form that is known here after is=", base, "define it before this one");
      }
      definition.meaning.schema = known.schema;
      std::move(known.added_slots.begin(), known.added_slots.end(), std::back_inserter(definition.meaning.added_slots));
    } else if (slot.name.empty() && slot.position == 0) {
      definition.meaning.added_slots.push_back(identifier_of(slot.value, "the name of a slot, as 'alpha"));
    } else {
      reject(slot.where, "the name of a slot, as 'alpha", slot.name.empty() ? "a position" : ":" + slot.name);
    }
  }
  if (definition.meaning.added_slots.size() > kMaxSlots) reject(where, "at most 1000 new slots in a form", "more");
  if (find_form(definition.name).schema == nullptr) definitions_.push_back(std::move(definition));
}

KnownForm FormDefinitions::find(const std::string& name) const {
  const auto built_in = find_form(name);
  if (built_in.schema != nullptr) return {.schema = built_in.schema, .added_slots = {}, .spelling = built_in.spelling};
  const auto defined = std::find_if(definitions_.rbegin(), definitions_.rend(),
                                    [&](const Definition& definition) { return definition.name == name; });
  return defined == definitions_.rend() ? KnownForm{} : defined->meaning;
}

namespace {

// Throws ParseError for a second value of one slot in a form.
template <class Matched>
void reject_repetition(const std::vector<Matched>& matched, const SlotSchema& schema, const Slot& slot) {
  for (const auto& earlier : matched) {
    if (earlier.schema != &schema) continue;
    reject(slot.where, "the slot :" + std::string(schema.name) + " once in its form",
           "it again, first at " + text_of(earlier.slot->where));
  }
}

[[noreturn]] void throw_violation(const ConstraintViolation& violation, const Location& where) {
  reject({.where = where, .slot = std::string(violation.slot), .error = {{}, violation.expected, violation.found, {}}});
}

bool accepts(const FormSlot& kind, const FormSchema& schema) {
  return std::find(kind.accepted.begin(), kind.accepted.end(), schema.name) != kind.accepted.end();
}

}  // namespace

void FormReader::read_all(const std::vector<Slot>& arguments) {
  for (const Slot& argument : arguments) {
    const auto* form = std::get_if<Form>(&argument.value.data);
    const bool by_order = argument.name.empty() && argument.position == 0;
    if (form == nullptr || !by_order) {
      reject(argument.where, "a form, as ( Apg70 ... )", by_order ? description(argument.value) : "a slot");
    }
    if (form->name == "def-form") {
      forms_.define(*form, argument.where);
    } else {
      read_top_level(*form, argument.where);
    }
  }
  for (const DeferredCheck& deferred : deferred_checks_) {
    if (const auto violation = deferred.check(builder_)) throw_violation(*violation, deferred.where);
  }
  for (const auto& [where, text] : paired_lists_.warnings(builder_)) warn(where, text);
}

void FormReader::read_top_level(const Form& form, const Location& where) {
  const KnownForm known = forms_.find(form.name);
  if (known.schema == nullptr) {
    warn_unknown_form(where, form.name);
    return;
  }
  if (known.schema->part_of_value) {
    reject(where, "a form that configures something, as ( Apg70 ... )", "( " + form.name + " ... ) alone",
           "put it into a slot");
  }
  read_form(form, where, known);
}

void FormReader::read_form(const Form& form, const Location& where, const KnownForm& known) {
  const FormSchema& schema = *known.schema;
  warn_spelling(where, form.name, schema.name, known.spelling);
  if (known.defined_in_text) {
    warn(where, "the form " + form.name + " is read as its base " + std::string(schema.name));
  }
  const auto matched = match_slots(form, known);
  if (schema.begin) schema.begin(builder_);
  for (const bool before_others : {true, false}) {
    for (const MatchedSlot& one : matched) {
      if (one.schema->before_others == before_others) read_slot(*one.schema, one.slot->value, std::string(schema.name));
    }
  }
  if (schema.check) {
    if (const auto violation = schema.check(builder_)) {
      const auto given = std::find_if(matched.begin(), matched.end(),
                                      [&](const MatchedSlot& one) { return one.schema->name == violation->slot; });
      throw_violation(*violation, given == matched.end() ? where : given->slot->value.where);
    }
  }
  if (schema.end) schema.end(builder_);
  if (schema.check_at_end) defer_check(schema, where);
}

void FormReader::defer_check(const FormSchema& schema, const Location& where) {
  std::erase_if(deferred_checks_, [&](const DeferredCheck& earlier) { return earlier.check == schema.check_at_end; });
  deferred_checks_.push_back({schema.check_at_end, where});
}

std::vector<FormReader::MatchedSlot> FormReader::match_slots(const Form& form, const KnownForm& known) {
  std::vector<MatchedSlot> matched;
  int index = 0;
  for (const Slot& slot : form.slots) {
    const SlotSchema* schema = row_of(slot, ++index, form, known);
    if (schema == nullptr) continue;
    reject_repetition(matched, *schema, slot);
    matched.push_back({schema, &slot});
  }
  return matched;
}

// Schema of a slot. `index`: number of the argument in its form, from 1. If the slot has no schema, the function warns
// and returns null. Throws ParseError for `is=`, and for a position greater than the number of slots.
const SlotSchema* FormReader::row_of(const Slot& slot, int index, const Form& form, const KnownForm& known) {
  const FormSchema& schema = *known.schema;
  if (slot.name.empty()) {
    const auto position = static_cast<std::size_t>(slot.position == 0 ? index : slot.position);
    if (position <= schema.slots.size()) return &schema.slots[position - 1];
    if (position > schema.slots.size() + known.added_slots.size()) {
      reject(slot.where,
             "at most " + std::to_string(schema.slots.size() + known.added_slots.size()) + " slots in " + form.name,
             "position " + std::to_string(position));
    }
    warn(slot.where, ":" + known.added_slots[position - schema.slots.size() - 1] + " is read, not used");
    return nullptr;
  }
  if (slot.name == "is=") reject(slot.where, "is= in a def-form only", "it in " + form.name);
  const auto found = find_slot(schema, slot.name);
  if (found.schema != nullptr) {
    warn_spelling(slot.where, ":" + slot.name, std::string(":").append(found.schema->name), found.spelling);
    return found.schema;
  }
  warn_unread(slot, form, known);
  return nullptr;
}

// Warns about a slot without a schema: a slot that a def-form adds, or an unknown slot.
void FormReader::warn_unread(const Slot& slot, const Form& form, const KnownForm& known) {
  if (warnings_.size() >= kMaxWarnings) return;
  if (std::find(known.added_slots.begin(), known.added_slots.end(), slot.name) != known.added_slots.end()) {
    warn(slot.where, ":" + slot.name + " is read, not used");
    return;
  }
  warn_unknown({.kind = Fault::Kind::unknown_slot,
                .where = slot.where,
                .form = form.name,
                .slot = slot.name,
                .nearest = nearest_slot(*known.schema, slot.name),
                .owner = std::string(form_with_slot(slot.name))});
}

void FormReader::read_slot(const SlotSchema& schema, const Value& value, const std::string& form) {
  const bool used = is_used(schema);
  if (!used && !unused_) {
    warn(value.where, std::string(":").append(schema.name) + " of " + form + " is read, not used" +
                          (schema.instead.empty() ? "" : ": " + std::string(schema.instead)));
  }
  const bool outer = std::exchange(unused_, unused_ || !used);
  if (const auto* kind = std::get_if<FormSlot>(&schema.binding)) {
    read_forms(schema, *kind, value, form);
  } else if (std::holds_alternative<AngleSlot>(schema.binding) && std::holds_alternative<Form>(value.data)) {
    const Form& angle = std::get<Form>(value.data);
    const KnownForm known = forms_.find(angle.name);
    if (known.schema == nullptr || known.schema->name != "lat-long") {
      reject_value(value.where, schema, description(value));
    }
    read_form(angle, value.where, known);
    read_sexagesimal(builder_, schema, value.where);
  } else if (const auto* list = std::get_if<ListSlot>(&schema.binding); list != nullptr && list->of != nullptr) {
    const std::vector<double> before = list->of(builder_);
    read_simple(builder_, schema, value);
    paired_lists_.slot_read(builder_, *list, before, value.where);
  } else {
    read_simple(builder_, schema, value);
  }
  unused_ = outer;
}

void FormReader::read_forms(const SlotSchema& schema, const FormSlot& kind, const Value& value,
                            const std::string& form) {
  if (kind.clear == nullptr) {
    read_items(schema, kind, value);
    return;
  }
  const FormSchema& item = *find_form(kind.accepted.front()).schema;
  const std::size_t before = item.count(builder_);
  kind.clear(builder_);
  read_items(schema, kind, value);
  if (before == 0 || notes_.size() >= kMaxWarnings) return;
  std::string text = text_of(value.where) + ": note: :" + std::string(schema.name) + " of " + form + ", with " +
                     text::counted(item.count(builder_), "form") + ' ' + std::string(item.name) + ", replaces " +
                     std::to_string(before) + " of earlier forms";
  for (const SlotSchema& other : find_form(form).schema->slots)
    if (other.same_as == schema.name) text += "; :" + std::string(other.name) + " adds to them instead";
  notes_.push_back(std::move(text));
}

void FormReader::read_items(const SlotSchema& schema, const FormSlot& kind, const Value& value) {
  const auto* list = std::get_if<List>(&value.data);
  if (list == nullptr || !kind.many) {
    read_form_of_slot(schema, kind, value, false);
    return;
  }
  for (const Value& item : list->items) read_form_of_slot(schema, kind, item, true);
}

void FormReader::read_form_of_slot(const SlotSchema& schema, const FormSlot& kind, const Value& value, bool in_list) {
  const auto* form = std::get_if<Form>(&value.data);
  if (form != nullptr && form->name == "def-form") {
    reject(value.where, "def-form outside all other forms", "it inside one");
  }
  const KnownForm known = form == nullptr ? KnownForm{} : forms_.find(form->name);
  const bool unknown = form != nullptr && known.schema == nullptr;
  if (unknown && in_list) {
    warn_unknown_form(value.where, form->name);
    return;
  }
  if (form == nullptr || unknown || !accepts(kind, *known.schema)) {
    reject_value(value.where, schema, description(value) + (unknown ? ", which is unknown" : ""));
  }
  read_form(*form, value.where, known);
  if (kind.store) kind.store(builder_);
}

void FormReader::warn(const Location& where, const std::string& text) {
  if (warnings_.size() < kMaxWarnings) warnings_.push_back(text_of(where) + ": " + text);
}

void FormReader::warn_unknown(Fault fault) {
  if (warnings_.size() >= kMaxWarnings) return;
  warn(fault.where, fault_text(fault));
  unknown_.push_back(std::move(fault));
}

void FormReader::warn_unknown_form(const Location& where, const std::string& name) {
  warn_unknown({.kind = Fault::Kind::unknown_form, .where = where, .form = name, .nearest = nearest_form(name)});
}

void FormReader::warn_spelling(const Location& where, const std::string& found, std::string_view modern,
                               Spelling spelling) {
  if (spelling == Spelling::exact) return;
  warn(where, found + " is an old spelling; write " + std::string(modern));
}

}  // namespace yars::config
