// Finds files: configurations, routes and scripts that came with YARS, by their name alone; and files whose names may
// differ in upper and lower case, as N36.SMC.PNG for n36.smc.png. Reads text files with one record a line: routes,
// tracks, scripts.
// Inputs: the name or the path of a regular file; the fields of one line.
// Outputs: the path of the file that exists; the whole file as one string; numbers that are checked against a range.
// Errors: an Error that names the file, or the line and the field. A folder that cannot be read has no entries.
// Threads: an object of FolderNames belongs to one thread; any thread may call the functions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::file {

// Folder PREFIX/share/yars/NAME of the installation that this code belongs to; empty: there is none. PREFIX is the
// folder, or one of its two parents, of the shared library that holds this code, else of the running program. So an
// installation can be moved. A build folder has the same form, and so has a Python package of a wheel.
std::filesystem::path installed_folder(std::string_view name = "config");

// Path of an installed file. A file in the current folder takes precedence. Else a name without a slash is searched in
// `folder` and its subfolders routes, scripts and legends. A name with a slash, or one found nowhere, is returned
// unchanged.
std::string installed_file(const std::string& name, const std::filesystem::path& folder = installed_folder());

// The text with the letters A to Z in lower case.
std::string lower_case(std::string text);

class FolderNames {
 public:
  // The entry at `path`, else an entry of the same folder whose name differs in case only; nullopt: neither exists. Of
  // several such names the first in byte order wins (A to Z before a to z). An entry may also be a folder, or a
  // symbolic link without a target. Each folder is listed at most once, so later changes may not be seen.
  std::optional<std::filesystem::path> find(const std::filesystem::path& path);

 private:
  using Names = std::map<std::string, std::string>;  // names in a folder, by the name in lower case
  static Names listed(const std::filesystem::path& folder);

  std::map<std::filesystem::path, Names> folders_;
};

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
