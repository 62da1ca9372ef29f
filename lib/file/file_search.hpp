// Finds files: configurations, routes and scripts that came with YARS, by their name alone; and files whose names may
// differ in upper and lower case, as N36.SMC.PNG for n36.smc.png.
// Inputs: the name or the path of a file.
// Outputs: the path of the file that exists.
// Errors: none. A folder that cannot be read has no entries.
// Threads: an object of FolderNames belongs to one thread; any thread may call the functions.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace yars::file {

// Folder PREFIX/share/yars/NAME of the installation that this code belongs to; empty: there is none. PREFIX is the
// folder, or one of its two parents, of the shared library that holds this code, else of the running program. So an
// installation can be moved. A build folder has the same form, and so has a Python package of a wheel.
std::filesystem::path installed_folder(std::string_view name = "config");

// Path of an installed file. A file in the current folder takes precedence. Else a name without a slash is searched in
// `folder` and its subfolders routes and scripts. A name with a slash, or one found nowhere, is returned unchanged.
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

}  // namespace yars::file
