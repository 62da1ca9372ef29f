#include "config/schema/form_reader.hpp"

#include <algorithm>
#include <utility>

#include "config/guf/parser.hpp"
#include "config/guf/tree.hpp"
#include "config/schema/slot_text.hpp"

namespace yars::config {

namespace {

const std::string& identifier_of(const Value& value, const char* expected) {
  const auto* identifier = std::get_if<Identifier>(&value.data);
  if (identifier == nullptr) reject(value.where, expected, description(value));
  return identifier->name;
}

}  // namespace

void FormBook::define(const Form& form, const Location& where) {
  constexpr std::size_t kMaxForms = 1000;  // bounds on the search; a person defines a handful
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
      KnownForm known = look_up(base);
      if (known.schema == nullptr && !known.defined_in_text) {
        reject(slot.value.where, "a form that is known here after is=", base, "define it before this one");
      }
      definition.meaning.schema = known.schema;
      std::move(known.own_slots.begin(), known.own_slots.end(), std::back_inserter(definition.meaning.own_slots));
    } else if (slot.name.empty() && slot.position == 0) {
      definition.meaning.own_slots.push_back(identifier_of(slot.value, "the name of a slot, as 'alpha"));
    } else {
      reject(slot.where, "the name of a slot, as 'alpha", slot.name.empty() ? "a position" : ":" + slot.name);
    }
  }
  if (definition.meaning.own_slots.size() > kMaxSlots) reject(where, "at most 1000 new slots in a form", "more");
  if (find_form(definition.name).schema == nullptr) definitions_.push_back(std::move(definition));
}

KnownForm FormBook::look_up(const std::string& name) const {
  const auto built_in = find_form(name);
  if (built_in.schema != nullptr) return {.schema = built_in.schema, .own_slots = {}, .spelling = built_in.spelling};
  const auto defined = std::find_if(definitions_.rbegin(), definitions_.rend(),
                                    [&](const Definition& definition) { return definition.name == name; });
  return defined == definitions_.rend() ? KnownForm{} : defined->meaning;
}

namespace {

// Refuses a second value for one slot of a form.
template <class Assigned>
void refuse_repetition(const std::vector<Assigned>& assigned, const SlotSchema& schema, const Slot& slot) {
  for (const auto& earlier : assigned) {
    if (earlier.schema != &schema) continue;
    reject(slot.where, "the slot :" + std::string(schema.name) + " once in its form",
           "it again, first at " + text_of(earlier.slot->where));
  }
}

[[noreturn]] void refuse(const ConstraintViolation& violation, const Location& where) {
  reject(where, violation.expected + " for :" + std::string(violation.slot), violation.found);
}

bool accepts(const FormSlot& kind, const FormSchema& schema) {
  return std::find(kind.accepted.begin(), kind.accepted.end(), schema.name) != kind.accepted.end();
}

}  // namespace

void FormReader::read_all(const std::vector<Slot>& arguments) {
  for (const Slot& argument : arguments) {
    const auto* form = std::get_if<Form>(&argument.value.data);
    const bool bare = argument.name.empty() && argument.position == 0;
    if (form == nullptr || !bare) {
      reject(argument.where, "a form, as ( Apg70 ... )", bare ? description(argument.value) : "a slot");
    }
    if (form->name == "def-form") {
      book_.define(*form, argument.where);
    } else {
      read_outermost(*form, argument.where);
    }
  }
  for (const Agreement& agreement : agreements_) {
    if (const auto violation = agreement.broken(draft_)) refuse(*violation, agreement.where);
  }
}

void FormReader::read_outermost(const Form& form, const Location& where) {
  const KnownForm known = book_.look_up(form.name);
  if (known.schema == nullptr) {
    warn(where, "the form " + form.name + " is unknown and ignored");
    return;
  }
  if (known.schema->part_of_value) {
    reject(where, "a form that configures something, as ( Apg70 ... )", "( " + form.name + " ... ) alone",
           "it belongs into a slot");
  }
  read_form(form, where, known);
}

void FormReader::read_form(const Form& form, const Location& where, const KnownForm& known) {
  const FormSchema& schema = *known.schema;
  warn_spelling(where, form.name, schema.name, known.spelling);
  if (known.defined_in_text) {
    warn(where, "the form " + form.name + " is read as its base " + std::string(schema.name));
  }
  const auto assigned = assign(form, known);
  if (schema.begin) schema.begin(draft_);
  for (const bool first : {true, false}) {
    for (const Assigned& one : assigned) {
      if (one.schema->before_others == first) read_slot(*one.schema, one.slot->value, std::string(schema.name));
    }
  }
  if (schema.check) {
    if (const auto violation = schema.check(draft_)) {
      const auto given = std::find_if(assigned.begin(), assigned.end(),
                                      [&](const Assigned& one) { return one.schema->name == violation->slot; });
      refuse(*violation, given == assigned.end() ? where : given->slot->value.where);
    }
  }
  if (schema.end) schema.end(draft_);
  if (schema.agree) note_agreement(schema, where);
}

void FormReader::note_agreement(const FormSchema& schema, const Location& where) {
  std::erase_if(agreements_, [&](const Agreement& earlier) { return earlier.broken == schema.agree; });
  agreements_.push_back({schema.agree, where});
}

std::vector<FormReader::Assigned> FormReader::assign(const Form& form, const KnownForm& known) {
  std::vector<Assigned> assigned;
  int place = 0;
  for (const Slot& slot : form.slots) {
    const SlotSchema* schema = row_of(slot, ++place, form, known);
    if (schema == nullptr) continue;
    refuse_repetition(assigned, *schema, slot);
    assigned.push_back({schema, &slot});
  }
  return assigned;
}

// The row of a slot; null for one that is read by nobody, after a warning.
const SlotSchema* FormReader::row_of(const Slot& slot, int place, const Form& form, const KnownForm& known) {
  const FormSchema& schema = *known.schema;
  if (slot.name.empty()) {
    const auto position = static_cast<std::size_t>(slot.position == 0 ? place : slot.position);
    if (position <= schema.slots.size()) return &schema.slots[position - 1];
    if (position > schema.slots.size() + known.own_slots.size()) {
      reject(slot.where,
             "at most " + std::to_string(schema.slots.size() + known.own_slots.size()) + " slots in " + form.name,
             "position " + std::to_string(position));
    }
    warn(slot.where, ":" + known.own_slots[position - schema.slots.size() - 1] + " is read, not used");
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

// A slot without a row: one of a def-form, or nobody's.
void FormReader::warn_unread(const Slot& slot, const Form& form, const KnownForm& known) {
  if (warnings_.size() >= kMaxWarnings) return;
  if (std::find(known.own_slots.begin(), known.own_slots.end(), slot.name) != known.own_slots.end()) {
    warn(slot.where, ":" + slot.name + " is read, not used");
    return;
  }
  const std::string_view nearest = nearest_slot(*known.schema, slot.name);
  warn(slot.where, "the form " + form.name + " has no slot :" + slot.name + "; it is ignored" +
                       (nearest.empty() ? "" : "; :" + std::string(nearest) + " is near"));
}

void FormReader::read_slot(const SlotSchema& schema, const Value& value, const std::string& form) {
  const bool used = is_used(schema);
  if (!used && !unused_) warn(value.where, std::string(":").append(schema.name) + " of " + form + " is read, not used");
  const bool outer = std::exchange(unused_, unused_ || !used);
  if (const auto* kind = std::get_if<FormSlot>(&schema.binding)) {
    read_forms(schema, *kind, value);
  } else if (std::holds_alternative<AngleSlot>(schema.binding) && std::holds_alternative<Form>(value.data)) {
    const Form& angle = std::get<Form>(value.data);
    const KnownForm known = book_.look_up(angle.name);
    if (known.schema == nullptr || known.schema->name != "lat-long") {
      reject(value.where, value_kind(schema) + " for :" + std::string(schema.name), description(value));
    }
    read_form(angle, value.where, known);
    read_sexagesimal(draft_, schema, value.where);
  } else {
    read_simple(draft_, schema, value);
  }
  unused_ = outer;
}

void FormReader::read_forms(const SlotSchema& schema, const FormSlot& kind, const Value& value) {
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
  const KnownForm known = form == nullptr ? KnownForm{} : book_.look_up(form->name);
  const bool unknown = form != nullptr && known.schema == nullptr;
  if (unknown && in_list) {
    warn(value.where, "the form " + form->name + " is unknown and ignored");
    return;
  }
  if (form == nullptr || unknown || !accepts(kind, *known.schema)) {
    reject(value.where, value_kind(schema) + " for :" + std::string(schema.name),
           description(value) + (unknown ? ", which is unknown" : ""));
  }
  read_form(*form, value.where, known);
  if (kind.take) kind.take(draft_);
}

void FormReader::warn(const Location& where, const std::string& text) {
  if (warnings_.size() < kMaxWarnings) warnings_.push_back(text_of(where) + ": " + text);
}

void FormReader::warn_spelling(const Location& where, const std::string& found, std::string_view modern,
                               Spelling spelling) {
  if (spelling == Spelling::exact) return;
  warn(where, found + " is an old spelling; write " + std::string(modern));
}

}  // namespace yars::config
