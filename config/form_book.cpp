#include "config/form_book.hpp"

#include <algorithm>

#include "config/rejection.hpp"

namespace yars::config {
namespace {

const std::string& identifier_of(const Value& value, const char* expected) {
  const auto* identifier = std::get_if<Identifier>(&value.data);
  if (identifier == nullptr) reject(value.where, expected, description(value));
  return identifier->name;
}

}  // namespace

void FormBook::define(const Form& form, const Location& where) {
  constexpr std::size_t kMostForms = 1000;  // bounds on the search; a person defines a handful
  constexpr std::size_t kMostSlots = 1000;
  if (form.slots.empty()) reject(where, "( def-form name is= base 'slot ... )", "no name");
  if (definitions_.size() >= kMostForms) reject(where, "at most 1000 forms defined", "one more");
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
  if (definition.meaning.own_slots.size() > kMostSlots) reject(where, "at most 1000 new slots in a form", "more");
  if (find_form(definition.name).schema == nullptr) definitions_.push_back(std::move(definition));
}

KnownForm FormBook::look_up(const std::string& name) const {
  const auto built_in = find_form(name);
  if (built_in.schema != nullptr) return {.schema = built_in.schema, .own_slots = {}, .spelling = built_in.spelling};
  const auto defined = std::find_if(definitions_.rbegin(), definitions_.rend(),
                                    [&](const Definition& definition) { return definition.name == name; });
  return defined == definitions_.rend() ? KnownForm{} : defined->meaning;
}

}  // namespace yars::config
