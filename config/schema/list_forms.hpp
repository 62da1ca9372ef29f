// Forms of the lists of the world that an instructor changes, too: a form for the list and one for an entry.
// Inputs: type of an entry, such as radar::RainCell; its Values (lib/values/fields.hpp) have the names, units, limits
// and defaults. Outputs: rows of the table of forms (schema.hpp).
// A list needs no code here. forms_world.cpp and forms_objects.cpp have the forms that have further slots.
#pragma once

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "config/schema/schema.hpp"
#include "lib/radar/world.hpp"

namespace yars::config {

template <class Entry>
Entry& entry_read(ConfigurationBuilder& builder) {
  return std::get<Entry>(builder.entries.of);
}
template <class Entry>
std::vector<Entry>& entries_of(ConfigurationBuilder& builder) {
  return std::get<std::vector<Entry>&>(radar::lists_of(builder.radar.world));
}

// Rules of an entry: the list has room for it, and it has coordinates.
template <class Entry>
std::optional<ConstraintViolation> check_entry_read(const ConfigurationBuilder& builder) {
  const auto& list = std::get<const std::vector<Entry>&>(radar::lists_of(std::as_const(builder.radar.world)));
  return check_entry(std::get<Entry>(builder.entries.of).position, list.size(), Entry::Values::list.most,
                     plural(Entry::Values::list));
}

// Slots of the values that Values::given lists.
template <class Entry, std::size_t... index>
void add_value_slots(std::vector<SlotSchema>& slots, std::index_sequence<index...> /*of the values*/) {
  using Values = typename Entry::Values;
  (slots.push_back(entry_slot(slot_name(Values::given[index]), Values::given[index],
                              [](ConfigurationBuilder& builder) -> double& {
                                return std::get<index>(Values::members)(entry_read<Entry>(builder));
                              })),
   ...);
}

// Form of one entry: its name, if it has one, its position and its values.
template <class Entry>
FormSchema entry_form() {
  FormSchema form{
      .name = Entry::Values::list.form,
      .purpose = Entry::Values::list.purpose,
      .part_of_value = true,
      .begin =
          [](ConfigurationBuilder& builder) {
            entry_read<Entry>(builder) = {};
            entry_read<Entry>(builder).position = {radar::kNotGiven, radar::kNotGiven};
          },
      .check = check_entry_read<Entry>,
      .end = [](ConfigurationBuilder& builder) { entries_of<Entry>(builder).push_back(entry_read<Entry>(builder)); },
      .count =
          [](const ConfigurationBuilder& builder) {
            return std::get<const std::vector<Entry>&>(radar::lists_of(std::as_const(builder.radar.world))).size();
          },
      .select = [](ConfigurationBuilder& builder,
                   std::size_t index) { entry_read<Entry>(builder) = entries_of<Entry>(builder)[index]; }};
  if constexpr (requires(Entry entry) { entry.name; })
    form.slots.push_back(
        {.name = "name",
         .binding = TextSlot{[](ConfigurationBuilder& builder) -> auto& { return entry_read<Entry>(builder).name; }},
         .purpose = "name, free text"});
  form.slots.push_back(latitude_slot(
      [](ConfigurationBuilder& builder) -> auto& { return entry_read<Entry>(builder).position.latitude_deg; }));
  form.slots.push_back(longitude_slot(
      [](ConfigurationBuilder& builder) -> auto& { return entry_read<Entry>(builder).position.longitude_deg; }));
  add_value_slots<Entry>(form.slots, std::make_index_sequence<Entry::Values::given.size()>());
  return form;
}

// Form of a list: a slot for entries that replace those of earlier forms, `slots`, and a slot for further entries.
template <class Entry>
FormSchema list_form(std::string_view slot = Entry::Values::list.name, std::vector<SlotSchema> slots = {}) {
  const values::List& list = Entry::Values::list;
  slots.insert(slots.begin(),
               list_slot(
                   slot, list.form, [](ConfigurationBuilder& builder) { entries_of<Entry>(builder).clear(); },
                   replaced_list(list.most, plural(list))));
  slots.push_back(more_slot(slot, list));
  return {.name = list.group, .purpose = purpose_of(list), .slots = std::move(slots)};
}

}  // namespace yars::config
