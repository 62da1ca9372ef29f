// Lists between commas and numbers in them, as options give them. Numbers are whole: nothing may follow.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace yars::tools::trade {

// One field at least; "" is one empty field.
std::vector<std::string_view> fields_of(std::string_view list);

std::optional<int> whole_number_of(std::string_view text);
std::optional<double> number_of(std::string_view text);  // finite

}  // namespace yars::tools::trade
