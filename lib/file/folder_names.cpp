#include "lib/file/folder_names.hpp"

#include <algorithm>
#include <system_error>

namespace yars::file {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return text;
}

FolderNames::Names FolderNames::listed(const std::filesystem::path& folder) {
  Names names;
  std::error_code code;
  std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, code);
  for (const std::filesystem::directory_iterator end; !code && entry != end; entry.increment(code)) {
    std::string name = entry->path().filename().string();
    const auto [found, fresh] = names.try_emplace(lower_case(name), name);
    if (!fresh && name < found->second) found->second = std::move(name);
  }
  return names;
}

std::optional<std::filesystem::path> FolderNames::find(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, code))) return path;
  const std::filesystem::path folder = path.parent_path();
  auto names = folders_.find(folder);
  if (names == folders_.end()) names = folders_.emplace(folder, listed(folder)).first;
  const auto name = names->second.find(lower_case(path.filename().string()));
  if (name == names->second.end()) return std::nullopt;
  return folder / name->second;
}

}  // namespace yars::file
