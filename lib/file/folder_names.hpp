// Finds files by names that may differ in upper and lower case: n36.smc.png finds N36.SMC.PNG.
// Inputs: the path of a file. Outputs: its path with the name as it is in the folder.
// Errors: none. A folder that cannot be read has no entries.
// Threads: an object belongs to one thread.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace yars::file {

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
