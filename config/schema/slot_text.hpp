// Prints slots, configurations and the manual.
// Inputs: a row of schema.hpp; a configuration.
// Outputs: GUF text that reads back as an equal configuration; Markdown.
// Units: printed values have the unit in the slot's row. The field has the unit in the field's name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/schema/schema.hpp"

namespace yars::config {

// The value of a slot as GUF text. Empty: the slot is unused (it writes no field) or contains forms, or its value is
// unknown (NaN, or a negative index of a ChoiceSlot).
std::string slot_text(ConfigurationBuilder& builder, const SlotSchema& slot);

// A configuration as GUF text, which reads back as an equal configuration. The text omits unused slots, slots with an
// unknown value, and slots with the same effect as another slot (SlotSchema::same_as).
std::string print_configuration(const radar::RadarConfiguration& configuration);

// Like print_configuration(), with a comment before each slot: position, kind, range, default, purpose. Forms that were
// not printed follow as comments.
std::string print_explained(const radar::RadarConfiguration& configuration);

// The form Devices as GUF text. Each radar::Device states what the buttons and axes of one input device do. A slot that
// has its default is left out.
std::string print_devices(const std::vector<radar::Device>& devices);

// The form Network as GUF text, with all slots.
std::string print_network(const radar::NetworkSettings& network);

// Names of the groups of forms. Every form is in one group. The manual has a page for each group:
// docs/configuration.md#forms-and-slots.
std::vector<std::string> form_groups();

// Manual of the forms of one group in Markdown, one table for each form: position, slot, value, default, purpose.
// Empty: `group` is not in form_groups().
std::string print_markdown(std::string_view group);

}  // namespace yars::config
