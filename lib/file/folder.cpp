#include "lib/file/folder.hpp"

#include <fcntl.h>
#include <limits.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <deque>
#include <fstream>

namespace yars::file {

using error::Expected;
using error::fail;

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

const char* name_of_kind(mode_t mode) {
  if (S_ISREG(mode)) return "a file";
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISLNK(mode)) return "a link";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

namespace {

// True for a user ID without a mapping in this user namespace. A sandbox shows all such users, even root, with one ID.
bool is_unmapped(uid_t user) {
  std::ifstream map("/proc/self/uid_map");
  for (std::uint64_t first = 0, outside = 0, count = 0; map >> first >> outside >> count;)
    if (user >= first && user - first < count) return false;
  return map.eof();
}

}  // namespace

// Opens a path component by component, each relative to the descriptor of the previous component.
class FolderWalk {
 public:
  FolderWalk(const std::filesystem::path& path, std::optional<mode_t> new_folder_mode)
      : new_folder_mode_(new_folder_mode) {
    push_front(path.empty() ? "." : path);
  }

  Expected<Folder> run(const std::filesystem::path& path) {
    if (!current_) current_ = Descriptor(::open(".", kOpen));
    while (!remaining_.empty()) {
      const std::filesystem::path step = remaining_.front();
      remaining_.pop_front();
      if (auto entered = enter(step); !entered) return tl::unexpected(entered.error());
    }
    if (!current_) return fail(path.string(), "a folder", error::reason_of(errno), "make it, or check the path");
    return Folder(std::move(current_), path);
  }

 private:
  static constexpr int kOpen = O_PATH | O_NOFOLLOW | O_CLOEXEC;
  static constexpr int kMaxLinks = 40;  // maximum number of symbolic links in a path, as in Linux; bounds a cycle

  // Puts the components of `path` before the remaining components. An absolute path starts at the root.
  void push_front(const std::filesystem::path& path) {
    std::deque<std::filesystem::path> all;
    for (const auto& part : path) all.push_back(part);
    if (path.is_absolute()) {
      current_ = Descriptor(::open("/", kOpen));
      all.pop_front();
      current_path_ = "/";
    }
    for (auto part = all.rbegin(); part != all.rend(); ++part)
      if (!part->empty()) remaining_.push_front(*part);
  }

  Expected<void> enter(const std::filesystem::path& step) {
    const std::filesystem::path step_path = current_path_ / step;
    Descriptor opened(::openat(current_.number(), step.c_str(), kOpen));
    if (!opened && errno == ENOENT && new_folder_mode_) {
      if (::mkdirat(current_.number(), step.c_str(), *new_folder_mode_) != 0 && errno != EEXIST)
        return fail(step_path.string(), "a folder that can be made", error::reason_of(errno),
                    "check the folder above it");
      opened = Descriptor(::openat(current_.number(), step.c_str(), kOpen));
    }
    struct stat status{};
    if (!opened || ::fstat(opened.number(), &status) != 0)
      return fail(step_path.string(), "a folder", error::reason_of(errno), "make it, or check the path");
    if (S_ISLNK(status.st_mode)) return follow(step_path, opened, status.st_uid);
    if (!S_ISDIR(status.st_mode)) return fail(step_path.string(), "a folder", name_of_kind(status.st_mode));
    current_ = std::move(opened);
    current_path_ = step_path;
    return {};
  }

  // True if a link with this owner may be followed: the owner is this user or root. In a sandbox the owner may have no
  // mapping. Then the link may be followed only in a folder that this user cannot write to.
  bool may_follow(uid_t owner) const {
    if (owner == ::geteuid() || owner == 0) return true;
    return is_unmapped(owner) && ::faccessat(current_.number(), ".", W_OK, AT_EACCESS) != 0;
  }

  Expected<void> follow(const std::filesystem::path& step_path, const Descriptor& link, uid_t owner) {
    if (!may_follow(owner))
      return fail(step_path.string(), "a folder, or a link made by this user or root",
                  "a link made by user " + std::to_string(owner), "name the folder that the link leads to");
    std::array<char, PATH_MAX> target{};
    const ssize_t length = ::readlinkat(link.number(), "", target.data(), target.size());
    if (length <= 0)
      return fail(step_path.string(), "a link that can be read",
                  length < 0 ? error::reason_of(errno) : "an empty link");
    if (++links_ > kMaxLinks) return fail(step_path.string(), "a link that leads to a folder", "a circle of links");
    push_front(std::string(target.data(), static_cast<std::size_t>(length)));
    return {};
  }

  std::optional<mode_t> new_folder_mode_;  // nullopt: missing folders are an error
  Descriptor current_;
  std::filesystem::path current_path_;
  std::deque<std::filesystem::path> remaining_;
  int links_ = 0;
};

Expected<Folder> Folder::open(const std::filesystem::path& path) {
  return FolderWalk(path, std::nullopt).run(path);
}

Expected<Folder> Folder::make(const std::filesystem::path& path, Rights rights) {
  return FolderWalk(path, rights == Rights::user_alone ? 0700 : 0755).run(path);
}

Expected<Folder> Folder::make_private(const std::filesystem::path& path) {
  auto folder = make(path, Rights::user_alone);
  if (!folder) return folder;
  struct stat status{};
  if (::fstat(folder->descriptor(), &status) != 0)
    return fail(path.string(), "a folder", error::reason_of(errno), "make it, or check the path");
  if (status.st_uid != ::geteuid() && status.st_uid != 0 && ::geteuid() != 0)
    return fail(path.string(), "a folder of this user", "a folder of user " + std::to_string(status.st_uid),
                "name a folder of your own");
  if ((status.st_mode & S_IWOTH) != 0)
    return fail(path.string(), "a folder that no other user may write to", "a folder that all users may write to",
                "name a new folder in it");
  const bool other_group = status.st_gid != ::getegid() && status.st_gid != 0;
  if ((status.st_mode & S_IWGRP) != 0 && other_group)
    return fail(path.string(), "a folder that no other user may write to",
                "a folder that group " + std::to_string(status.st_gid) + " may write to", "name a new folder in it");
  return folder;
}

namespace {

// True if the descriptor has the file of this status open.
bool is_open_file(int descriptor, const struct stat& there) {
  struct stat here{};
  return ::fstat(descriptor, &here) == 0 && here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

}  // namespace

bool Folder::is_at_path() const {
  struct stat there{};
  return ::stat(path_.empty() ? "." : path_.c_str(), &there) == 0 && is_open_file(descriptor(), there);
}

bool Folder::has_at_path(const std::string& name, int open_file) const {
  const auto there = status_of(name);
  return there && is_open_file(open_file, *there) && is_at_path();
}

std::optional<struct stat> Folder::status_of(const std::string& name) const {
  struct stat status{};
  if (::fstatat(descriptor(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return std::nullopt;
  return status;
}

bool Folder::remove(const std::string& name) const {
  return ::unlinkat(descriptor(), name.c_str(), 0) == 0;
}

bool Folder::rename_file(const std::string& name, const std::string& new_name) const {
  return ::renameat(descriptor(), name.c_str(), descriptor(), new_name.c_str()) == 0;
}

}  // namespace yars::file
