#include "shm/segment_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <random>
#include <string_view>
#include <utility>

namespace yars::shm {

namespace {

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Paths of the entries of a folder that have a number as their name. Empty if the folder may not be read.
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

// True for "PATH (deleted)" and "PATH.123.tmp (deleted)". /proc shows the name by which the file was opened.
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

// True for a regular file of this user with link count 0. The text "(deleted)" alone does not suffice: until link_as()
// has opened the file again, /proc shows the removed temporary name of a file that already has its final name.
// Files that are not regular, such as pipes, must not be opened.
bool is_own_and_nameless(const std::string& descriptor) {
  struct stat status{};
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

namespace bi = boost::interprocess;

namespace {

constexpr int kNameAttempts = 20;  // maximum number of random temporary names that create() tries

struct flock byte_lock(std::size_t byte, LockKind kind) {
  struct flock lock{};
  lock.l_type = kind == LockKind::none ? F_UNLCK : kind == LockKind::read ? F_RDLCK : F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(byte);
  lock.l_len = 1;
  return lock;
}

// Adapter that passes a file descriptor to Boost's mapped_region, which does not close the descriptor.
struct OpenFile {
  int descriptor;
  bi::mapping_handle_t get_mapping_handle() const { return {descriptor, false}; }
};

}  // namespace

std::optional<SegmentFile> SegmentFile::open(const std::string& file_name, Access access) {
  // O_NONBLOCK: another user may put a pipe at this path. Without the flag, opening a pipe waits until a process opens
  // the pipe's other end.
  const int mode = access == Access::read_only ? O_RDONLY : O_RDWR;
  file::Descriptor opened(::open(path_of(file_name).c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!opened) return std::nullopt;
  SegmentFile file(std::move(opened), access);
  if (S_ISREG(file.status().st_mode)) return file;
  errno = EINVAL;
  return std::nullopt;
}

std::optional<SegmentFile> SegmentFile::create(const std::string& file_name) {
  SegmentFile file(file::Descriptor(::open(kSegmentFolder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600)), Access::read_write);
  for (int attempt = 0; !file.descriptor_ && errno != ENOSPC && errno != ENOMEM && attempt < kNameAttempts; ++attempt) {
    file.temporary_ = file_name + "." + std::to_string(std::random_device{}()) + ".tmp";
    file.descriptor_ = file::Descriptor(
        ::open(path_of(file.temporary_).c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  }
  if (file.descriptor_) return file;
  return std::nullopt;
}

bool SegmentFile::link_as(const std::string& file_name) {
  const std::string itself = "/proc/self/fd/" + std::to_string(descriptor());
  const std::string path = path_of(file_name);
  const int error = temporary_.empty() ? ::linkat(AT_FDCWD, itself.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW)
                                       : ::link(path_of(temporary_).c_str(), path.c_str());
  if (error != 0) return false;
  remove_temporary();
  // Opens the file again by its name. If the file is unlinked later, /proc then shows this name to nameless_files().
  auto named = open(file_name, access_);
  if (named && is_at(path) && named->is_at(path) && named->lock(0, LockKind::read)) {
    lock(0, LockKind::none);  // explicitly, because the mapping keeps the old description and its locks alive
    std::swap(descriptor_, named->descriptor_);
  }
  return true;
}

void SegmentFile::remove_temporary() {
  if (!temporary_.empty()) ::unlink(path_of(temporary_).c_str());
  temporary_.clear();
}

std::optional<SegmentFile> SegmentFile::reopen(const std::string& path, Access access) {
  file::Descriptor opened(::open(path.c_str(), (access == Access::read_only ? O_RDONLY : O_RDWR) | O_CLOEXEC));
  if (!opened) return std::nullopt;
  return SegmentFile(std::move(opened), access);
}

bool SegmentFile::lock(std::size_t byte, LockKind kind) {
  struct flock wanted = byte_lock(byte, kind);
  return fcntl(descriptor(), F_OFD_SETLK, &wanted) == 0;
}

bool SegmentFile::could_write_lock(std::size_t byte) const {
  struct flock wanted = byte_lock(byte, LockKind::write);
  return fcntl(descriptor(), F_OFD_GETLK, &wanted) == 0 && wanted.l_type == F_UNLCK;
}

int SegmentFile::allocate(std::uint64_t size) {
  int error = EINTR;
  while (error == EINTR) error = posix_fallocate(descriptor(), 0, static_cast<off_t>(size));
  return error;
}

bool SegmentFile::map() {
  try {
    bi::mapped_region region(OpenFile{descriptor()}, access_ == Access::read_only ? bi::read_only : bi::read_write);
    region_.swap(region);
    return true;
  } catch (const bi::interprocess_exception& refusal) {
    errno = refusal.get_native_error();
    return false;
  }
}

struct stat SegmentFile::status() const {
  struct stat status{};
  if (fstat(descriptor(), &status) != 0) status = {};
  return status;
}

bool SegmentFile::is_at(const std::string& path) const {
  struct stat there{};
  const struct stat here = status();
  return lstat(path.c_str(), &there) == 0 && there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

}  // namespace yars::shm
