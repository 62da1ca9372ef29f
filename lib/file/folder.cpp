#include "lib/file/folder.hpp"

#include <fcntl.h>
#include <limits.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
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

// A user namespace, such as that of a sandbox, shows users that it does not know by one number, root too.
bool is_unknown_here(uid_t user) {
  std::ifstream map("/proc/self/uid_map");
  for (std::uint64_t first = 0, outside = 0, count = 0; map >> first >> outside >> count;)
    if (user >= first && user - first < count) return false;
  return map.eof();
}

}  // namespace

// Steps from folder to folder, each opened from the descriptor of the one before.
class FolderWalk {
 public:
  FolderWalk(const std::filesystem::path& path, std::optional<mode_t> missing) : missing_(missing) {
    push_front(path.empty() ? "." : path);
  }

  Expected<Folder> run(const std::filesystem::path& path) {
    if (!here_) here_ = Descriptor(::open(".", kOpen));
    while (!steps_.empty()) {
      const std::filesystem::path step = steps_.front();
      steps_.pop_front();
      if (auto taken = take(step); !taken) return tl::unexpected(taken.error());
    }
    if (!here_) return fail(path.string(), "a folder", std::strerror(errno));
    return Folder(std::move(here_), path);
  }

 private:
  static constexpr int kOpen = O_PATH | O_NOFOLLOW | O_CLOEXEC;
  static constexpr int kMaxLinks = 40;  // as the kernel's own limit: a circle of links ends

  // An absolute path begins again at the root.
  void push_front(const std::filesystem::path& path) {
    std::deque<std::filesystem::path> all;
    for (const auto& part : path) all.push_back(part);
    if (path.is_absolute()) {
      here_ = Descriptor(::open("/", kOpen));
      all.pop_front();
      walked_ = "/";
    }
    for (auto part = all.rbegin(); part != all.rend(); ++part)
      if (!part->empty()) steps_.push_front(*part);
  }

  Expected<void> take(const std::filesystem::path& step) {
    const std::filesystem::path shown = walked_ / step;
    Descriptor next(::openat(here_.number(), step.c_str(), kOpen));
    if (!next && errno == ENOENT && missing_) {
      if (::mkdirat(here_.number(), step.c_str(), *missing_) != 0 && errno != EEXIST)
        return fail(shown.string(), "a folder that can be made", std::strerror(errno), "check the folder above it");
      next = Descriptor(::openat(here_.number(), step.c_str(), kOpen));
    }
    struct stat status {};
    if (!next || ::fstat(next.number(), &status) != 0) return fail(shown.string(), "a folder", std::strerror(errno));
    if (S_ISLNK(status.st_mode)) return follow(shown, next, status.st_uid);
    if (!S_ISDIR(status.st_mode)) return fail(shown.string(), "a folder", name_of_kind(status.st_mode));
    here_ = std::move(next);
    walked_ = shown;
    return {};
  }

  // What a sandbox does not show the owner of is trusted where this user cannot write.
  bool may_follow(uid_t owner) const {
    if (owner == ::geteuid() || owner == 0) return true;
    return is_unknown_here(owner) && ::faccessat(here_.number(), ".", W_OK, AT_EACCESS) != 0;
  }

  Expected<void> follow(const std::filesystem::path& shown, const Descriptor& link, uid_t owner) {
    if (!may_follow(owner))
      return fail(shown.string(), "a folder, or a link made by this user or root",
                  "a link made by user " + std::to_string(owner), "name the folder that it leads to");
    std::array<char, PATH_MAX> target{};
    const ssize_t length = ::readlinkat(link.number(), "", target.data(), target.size());
    if (length <= 0 || ++links_ > kMaxLinks)
      return fail(shown.string(), "a link that leads to a folder", "a circle of links");
    push_front(std::string(target.data(), static_cast<std::size_t>(length)));
    return {};
  }

  std::optional<mode_t> missing_;  // mode of folders to make
  Descriptor here_;
  std::filesystem::path walked_;
  std::deque<std::filesystem::path> steps_;
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
  struct stat status {};
  if (::fstat(folder->descriptor(), &status) != 0) return fail(path.string(), "a folder", std::strerror(errno));
  if (status.st_uid != ::geteuid() && status.st_uid != 0 && ::geteuid() != 0)
    return fail(path.string(), "a folder of this user", "one of user " + std::to_string(status.st_uid),
                "name a folder of your own");
  if ((status.st_mode & S_IWOTH) != 0)
    return fail(path.string(), "a folder that no other user may write to", "one that any user may",
                "name a new folder in it");
  return folder;
}

std::optional<struct stat> Folder::look(const std::string& name) const {
  struct stat status {};
  if (::fstatat(descriptor(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return std::nullopt;
  return status;
}

bool Folder::remove(const std::string& name) const {
  return ::unlinkat(descriptor(), name.c_str(), 0) == 0;
}

bool Folder::set_aside(const std::string& name, const std::string& other) const {
  return ::renameat(descriptor(), name.c_str(), descriptor(), other.c_str()) == 0;
}

}  // namespace yars::file
