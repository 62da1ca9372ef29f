#include "tools/output_name.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "databuffer/program.hpp"
#include "lib/file/new_file.hpp"
#include "tools/command.hpp"

namespace yars::tools {

std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

void check_file_name(const std::string& option, const std::string& name, const std::vector<std::string>& endings) {
  const std::string ending = ending_of(name);
  if (name.empty()) return;
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) {
    // A file that is begun and given up leaves nothing behind.
    if (const auto begun = file::NewFile::create(name); !begun) give_up(begun.error());
    return;
  }
  std::string expected = "a name that ends in " + endings.front();
  for (std::size_t i = 1; i < endings.size(); ++i) expected += (i + 1 < endings.size() ? ", " : " or ") + endings[i];
  give_up(databuffer::usage_error(option, expected, name));
}

void check_folder_name(const std::string& option, const std::string& name) {
  static const std::vector<std::string> kFiles = {".png", ".tif", ".tiff", ".jp2", ".img", ".csv", ".f32", ".hgt",
                                                  ".zip", ".gz",  ".dt0",  ".dt1", ".dt2", ".ded", ".flt", ".guf"};
  const std::string ending = ending_of(name);
  if (std::find(kFiles.begin(), kFiles.end(), ending) != kFiles.end())
    give_up(databuffer::usage_error(option, "the name of a folder", name + ", which ends like that of a file"));
}

}  // namespace yars::tools
