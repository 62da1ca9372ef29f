#include "lib/file/file_search.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <string_view>
#include <system_error>

namespace yars::file {

namespace {

namespace fs = std::filesystem;

// PREFIX/share/yars/NAME for a program in PREFIX/bin or PREFIX/libexec/yars, a library in PREFIX/lib/TRIPLET, or a
// Python module in PREFIX, the folder of its package.
std::optional<fs::path> folder_near(const fs::path& binary, std::string_view name) {
  std::error_code problem;
  fs::path folder = fs::weakly_canonical(binary, problem).parent_path();
  for (int levels = 0; levels < 3 && !folder.empty(); ++levels, folder = folder.parent_path()) {
    if (const fs::path found = folder / "share/yars" / name; fs::is_directory(found, problem))
      return fs::weakly_canonical(found, problem);
  }
  return std::nullopt;
}

}  // namespace

fs::path installed_folder(std::string_view name) {
  // A library comes first: the program that loads it, such as Python, may belong to another installation. For a
  // program's own code dladdr has the name that it was started by, which is no path when it came from PATH.
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&installed_folder), &library) != 0 && library.dli_fname != nullptr &&
      fs::path(library.dli_fname).is_absolute())
    if (auto found = folder_near(library.dli_fname, name)) return *std::move(found);
  std::error_code problem;
  return folder_near(fs::read_symlink("/proc/self/exe", problem), name).value_or(fs::path());
}

std::string installed_file(const std::string& name, const fs::path& folder) {
  std::error_code problem;
  if (name.empty() || folder.empty() || name.find('/') != std::string::npos || fs::exists(name, problem)) return name;
  for (const char* part : {"", "routes", "scripts"})
    if (const fs::path file = folder / part / name; fs::is_regular_file(file, problem)) return file.string();
  return name;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return text;
}

FolderNames::Names FolderNames::listed(const fs::path& folder) {
  Names names;
  std::error_code code;
  fs::directory_iterator entry(folder.empty() ? "." : folder, code);
  for (const fs::directory_iterator end; !code && entry != end; entry.increment(code)) {
    std::string name = entry->path().filename().string();
    const auto [found, fresh] = names.try_emplace(lower_case(name), name);
    if (!fresh && name < found->second) found->second = std::move(name);
  }
  return names;
}

std::optional<fs::path> FolderNames::find(const fs::path& path) {
  std::error_code code;
  if (fs::exists(fs::symlink_status(path, code))) return path;
  const fs::path folder = path.parent_path();
  auto names = folders_.find(folder);
  if (names == folders_.end()) names = folders_.emplace(folder, listed(folder)).first;
  const auto name = names->second.find(lower_case(path.filename().string()));
  if (name == names->second.end()) return std::nullopt;
  return folder / name->second;
}

}  // namespace yars::file
