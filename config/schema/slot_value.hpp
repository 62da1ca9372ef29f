// Reads one value of a configuration file into the field of its slot. Warns about lists whose numbers belong together
// by position, such as pulse widths and ranges. Inputs: a row of schema.hpp, a value of the syntax tree; at the end the
// configuration. Output: the field of the slot. A warning for each pair of lists with different numbers of values, and
// for each pair of which a file changes the first list alone. It names both slots and shows which value now belongs to
// which. None for a second list with one value, which applies to all, or without a value.
// Units: the value has the unit in the slot's row. The field has the unit in the field's name; NumberSlot converts.
// Errors: ParseError with location, kind and range of the slot, and the value found.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"

namespace yars::config {

// Throws ParseError for a value that the slot does not take. Its fault names the slot and its limits.
[[noreturn]] void reject_value(const Location& where, const SlotSchema& slot, std::string found,
                               std::string action = {});

// Validates one value and writes it into the field of its slot. Throws ParseError. Values that are forms are read by
// FormReader instead. For a lat-long form, FormReader fills builder.angle and then calls read_sexagesimal(). A call of
// read_simple() for a FormSlot aborts the program.
void read_simple(ConfigurationBuilder& builder, const SlotSchema& slot, const Value& value);

// Writes the latitude or longitude in builder.angle into the field of `slot`. `where` is the location of the form.
// Throws ParseError for a latitude with E or W, a longitude with N or S, or an angle out of range.
void read_sexagesimal(ConfigurationBuilder& builder, const SlotSchema& slot, const Location& where);

class PairedLists {
 public:
  // A slot with a list of numbers (`slot.of`) was read. `before`: its values before that. `where`: location of the new.
  void slot_read(ConfigurationBuilder& builder, const ListSlot& slot, const std::vector<double>& before,
                 const Location& where);
  // Location and text of each warning.
  struct Warning {
    Location where;
    std::string text;
  };
  std::vector<Warning> warnings(ConfigurationBuilder& builder) const;

 private:
  static constexpr std::size_t kPairs = 5;
  struct State {
    std::optional<Location> first, second;  // where the lists were given last
    std::vector<double> changed_from;       // first list for which the second was given; empty: for the present one
  };
  std::array<State, kPairs> states_;
};

}  // namespace yars::config
