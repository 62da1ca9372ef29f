#include "shm/segment_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <utility>

namespace yars::shm {

namespace bi = boost::interprocess;

namespace {

constexpr const char* kFolder = "/dev/shm";  // where glibc's shm_open and Boost keep their objects
constexpr int kAttempts = 20;                // at a random name

std::string path_of(const std::string& file_name) {
  return std::string(kFolder) + "/" + file_name;
}

struct flock byte_lock(std::size_t byte, LockKind kind) {
  struct flock lock {};
  lock.l_type = kind == LockKind::none ? F_UNLCK : kind == LockKind::read ? F_RDLCK : F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(byte);
  lock.l_len = 1;
  return lock;
}

// What Boost maps; it wants no more of it than the handle.
struct OpenFile {
  int descriptor;
  bi::mapping_handle_t get_mapping_handle() const { return {descriptor, false}; }
};

}  // namespace

std::optional<SegmentFile> SegmentFile::open(const std::string& file_name, Access access) {
  // Any user may put a pipe there, and opening that would wait for its other end.
  const int mode = access == Access::read_only ? O_RDONLY : O_RDWR;
  file::Descriptor opened(::open(path_of(file_name).c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!opened) return std::nullopt;
  SegmentFile file(std::move(opened), access);
  if (S_ISREG(file.status().st_mode)) return file;
  errno = EINVAL;
  return std::nullopt;
}

std::optional<SegmentFile> SegmentFile::create(const std::string& file_name) {
  SegmentFile file(file::Descriptor(::open(kFolder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600)), Access::read_write);
  for (int attempt = 0; !file.descriptor_ && errno != ENOSPC && errno != ENOMEM && attempt < kAttempts; ++attempt) {
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
  const int done = temporary_.empty() ? ::linkat(AT_FDCWD, itself.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW)
                                      : ::link(path_of(temporary_).c_str(), path.c_str());
  if (done != 0) return false;
  remove_temporary();
  // Opened by its name, the system goes on showing that name when somebody removes it: nameless_file.hpp.
  auto named = open(file_name, access_);
  if (named && is_at(path) && named->is_at(path) && named->lock(0, LockKind::read)) {
    lock(0, LockKind::none);  // the mapping keeps the old description, and its locks, alive
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
  struct stat status {};
  if (fstat(descriptor(), &status) != 0) status = {};
  return status;
}

bool SegmentFile::is_at(const std::string& path) const {
  struct stat there {};
  const struct stat here = status();
  return lstat(path.c_str(), &there) == 0 && there.st_dev == here.st_dev && there.st_ino == here.st_ino;
}

}  // namespace yars::shm
