// Text files that people write: read as one string; numbers of a line with names and ranges.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::file {

// A whole text file as one string, for the parsers of routes, tracks and scripts.

// An error when the file cannot be opened, is a folder, or is larger than 256 MiB.
error::Expected<std::string> read_text_file(const std::filesystem::path& path);

// Several numbers of one line, each with its name and range, as routes, tracks and options write them.
struct NumberField {
  std::string_view name;
  double least;
  double most;
};

// One number a field, in this order, ends of the ranges included. An error has the subject given and names the
// field, or all fields (joined by `separator`) when their count is wrong.
error::Expected<std::vector<double>> parse_numbers(const std::string& subject,
                                                   const std::vector<std::string_view>& texts,
                                                   const std::vector<NumberField>& fields, std::string_view separator);

// "FILE:12": where in a file something is.
std::string place_in_file(std::string_view file, int line);

}  // namespace yars::file
