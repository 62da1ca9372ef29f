#include "lib/file/log_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

namespace yars::file {

using failure::Expected;
using failure::fail;

namespace {

constexpr const char* kAdvice = "remove it, or name another folder";

// What stands in the way of continuing it; nullopt: nothing. A second name would make it a file of somewhere else.
std::optional<std::string> obstacle(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return name_of_kind(status.st_mode);
  if (status.st_uid != ::geteuid()) return "a file of user " + std::to_string(status.st_uid);
  if (status.st_nlink != 1) return "a file with " + std::to_string(status.st_nlink) + " names";
  return std::nullopt;
}

}  // namespace

Expected<LogFile> LogFile::open(Folder folder, std::string name, Limits limits) {
  LogFile file(std::move(folder), std::move(name), limits);
  if (auto opened = file.open_newest(); !opened) return tl::unexpected(opened.error());
  return file;
}

std::string LogFile::name_of(std::size_t age) const {
  return age == 0 ? name_ + ".log" : name_ + "." + std::to_string(age) + ".log";
}

Expected<void> LogFile::open_newest() {
  const std::string name = name_of(0);
  const std::string shown = (folder_.path() / name).string();
  // Not opened at all when it is no file: opening a device or a pipe may already do something.
  const auto there = folder_.look(name);
  if (there)
    if (const auto found = obstacle(*there)) return fail(shown, "a log file of this user", *found, kAdvice);
  newest_ = Descriptor(::openat(folder_.descriptor(), name.c_str(),
                                O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0600));
  struct stat status {};
  if (!newest_ || ::fstat(newest_.number(), &status) != 0)
    return fail(shown, "a log file that can be written", std::strerror(errno), "check the folder and its rights");
  if (const auto found = obstacle(status)) return fail(shown, "a log file of this user", *found, kAdvice);
  ::fchmod(newest_.number(), 0600);
  bytes_ = static_cast<std::size_t>(status.st_size);
  return {};
}

Expected<void> LogFile::set_aside() {
  for (std::size_t age = limits_.old; age > 0; --age) folder_.set_aside(name_of(age - 1), name_of(age));
  // Where it cannot be set aside, or is not to be, it ends: no log grows without a limit.
  folder_.remove(name_of(0));
  return open_newest();
}

Expected<void> LogFile::append(std::string_view text) {
  if (bytes_ > 0 && bytes_ + text.size() > limits_.bytes)
    if (auto fresh = set_aside(); !fresh) return fresh;
  while (!text.empty()) {
    const ssize_t count = ::write(newest_.number(), text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      return fail((folder_.path() / name_of(0)).string(), "a log file that can be written", std::strerror(errno),
                  "check the space on the disk");
    bytes_ += static_cast<std::size_t>(count);
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

}  // namespace yars::file
