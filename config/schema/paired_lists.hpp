// Warnings about lists whose numbers belong together by position, such as pulse widths and ranges.
// Inputs: each list slot that a configuration gives, in the order of its text; at the end the configuration.
// Outputs: a warning for each pair of lists with different numbers of values, and for each pair of which a file changes
// the first list alone. It names both slots and shows which value now belongs to which.
// Not warned of: a second list with one value, which applies to all, or without a value.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "config/guf/tree.hpp"
#include "config/schema/schema.hpp"

namespace yars::config {

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
