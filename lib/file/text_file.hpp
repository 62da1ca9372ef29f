// Reader of text files with one record a line: routes, tracks, scripts.
// Inputs: the path of a regular file; the fields of one line.
// Outputs: the whole file as one string; numbers that are checked against a range.
// Errors: an Error that names the file, or the line and the field.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::file {

// The whole file as one string. Errors: the file is missing or unreadable, is not a regular file, is larger than
// 256 MiB, or has more than 10 million lines.
error::Expected<std::string> read_text_file(const std::filesystem::path& path);

// The first `max_bytes` bytes of a regular file, or all if there are fewer. The size in the file's status may be wrong;
// it is 0 for files in /proc. The call does not block on a pipe. nullopt: the file is not regular, or cannot be
// read; errno has the reason.
std::optional<std::string> read_regular_file(const std::filesystem::path& path, std::size_t max_bytes);

// Name and range [min, max] of one number of a line.
struct NumberField {
  std::string_view name;
  double min;
  double max;
};

// The numbers in `texts`, one for each field, in the order of `fields`. An error has the subject `subject` and names
// the wrong field. If the number of texts is wrong, the error names all fields, joined by `separator`.
error::Expected<std::vector<double>> parse_numbers(const std::string& subject,
                                                   const std::vector<std::string_view>& texts,
                                                   const std::vector<NumberField>& fields, std::string_view separator);

// "FILE:12", the subject of errors in line 12 of a file.
std::string line_location(std::string_view file, int line);

}  // namespace yars::file
