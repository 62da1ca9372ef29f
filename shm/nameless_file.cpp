#include "shm/nameless_file.hpp"

#include <dirent.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

namespace yars::shm {

namespace {

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Entries of a folder whose name is a number; none of a folder that may not be read.
std::vector<std::string> numbered_entries(const std::string& folder) {
  std::vector<std::string> entries;
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(opendir(folder.c_str()), closedir);
  if (!stream) return entries;
  while (const dirent* entry = readdir(stream.get()))
    if (is_number(entry->d_name)) entries.push_back(folder + "/" + entry->d_name);
  return entries;
}

std::string target_of(const std::string& link) {
  std::array<char, PATH_MAX> text;
  const ssize_t length = readlink(link.c_str(), text.data(), text.size());
  return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : std::string();
}

// "PATH (deleted)" or "PATH.123.tmp (deleted)": the system shows the name by which the file was opened.
bool was_opened_as(const std::string& target, const std::string& path) {
  constexpr std::string_view kDeleted = " (deleted)";
  constexpr std::string_view kTemporary = ".tmp";
  if (!target.starts_with(path) || !target.ends_with(kDeleted)) return false;
  std::string_view rest = std::string_view(target).substr(path.size());
  rest.remove_suffix(kDeleted.size());
  if (rest.empty()) return true;
  if (!rest.starts_with('.') || !rest.ends_with(kTemporary) || rest.size() <= 1 + kTemporary.size()) return false;
  return is_number(rest.substr(1, rest.size() - 1 - kTemporary.size()));
}

// A creator's file is shown as deleted, but lives on under the session's name: the count of names tells. What another
// user has put there under that name, a pipe for instance, is not opened.
bool is_own_and_nameless(const std::string& descriptor) {
  struct stat status {};
  return stat(descriptor.c_str(), &status) == 0 && status.st_nlink == 0 && S_ISREG(status.st_mode) &&
         status.st_uid == geteuid();
}

}  // namespace

std::vector<std::string> nameless_files(const std::string& path) {
  std::vector<std::string> found;
  for (const std::string& process : numbered_entries("/proc"))
    for (const std::string& descriptor : numbered_entries(process + "/fd"))
      if (was_opened_as(target_of(descriptor), path) && is_own_and_nameless(descriptor)) found.push_back(descriptor);
  return found;
}

}  // namespace yars::shm
