// Lists between commas and numbers in them, as options give them. Nothing may follow a number.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/failure/error.hpp"

namespace yars::tools::trade {

// One field at least; "" is one empty field.
std::vector<std::string_view> fields_of(std::string_view list);

std::optional<int> whole_number_of(std::string_view text);
std::optional<double> number_of(std::string_view text);  // finite

struct Bounds {
  std::string_view name;  // with its unit
  double least, most;
};

// From "37,-122": as many numbers as bounds. Errors, of bad usage, name `subject` and what `form` it takes.
failure::Expected<std::vector<double>> numbers_of(std::string_view list, std::span<const Bounds> bounds,
                                                  std::string_view subject, std::string_view form);

// Six digits that count, as short as can be.
std::string short_number(double value);

}  // namespace yars::tools::trade
