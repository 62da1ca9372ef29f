// Several numbers of one line, each with its name and range, as routes, tracks and options write them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "databuffer/records/plain_text.hpp"
#include "lib/failure/error.hpp"

namespace yars::databuffer::flight {

struct NumberField {
  std::string_view name;
  double least;
  double most;
};

// One number a field, in this order, ends of the ranges included. An error has the subject given and names the
// field, or all fields (joined by `separator`) when their count is wrong.
failure::Expected<std::vector<double>> parse_numbers(const std::string& subject,
                                                     const std::vector<std::string_view>& texts,
                                                     const std::vector<NumberField>& fields,
                                                     std::string_view separator);

// "FILE:12": where in a file something is.
std::string place_in_file(std::string_view file, int line);

}  // namespace yars::databuffer::flight
