#include "shm/segment_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace yars::shm {

namespace bi = boost::interprocess;

namespace {

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

SegmentFile::Descriptor& SegmentFile::Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

SegmentFile::Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

SegmentFile::SegmentFile(boost::interprocess::shared_memory_object object, Access access)
    : object_(std::move(object)), access_(access) {}
SegmentFile::SegmentFile(Descriptor reopened, Access access) : reopened_(std::move(reopened)), access_(access) {}

std::optional<SegmentFile> SegmentFile::open(const std::string& file_name, Access access) {
  // Not by shm_open: any user may put a pipe there, and opening that would wait for its other end.
  const std::string path = "/dev/shm/" + file_name;
  const int mode = access == Access::read_only ? O_RDONLY : O_RDWR;
  Descriptor opened(::open(path.c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (opened.number() < 0) return std::nullopt;
  SegmentFile file(std::move(opened), access);
  if (S_ISREG(file.status().st_mode)) return file;
  errno = EINVAL;
  return std::nullopt;
}

std::optional<SegmentFile> SegmentFile::create(const std::string& file_name) {
  try {
    return SegmentFile(
        bi::shared_memory_object(bi::create_only, file_name.c_str(), bi::read_write, bi::permissions(0600)),
        Access::read_write);
  } catch (const bi::interprocess_exception& refusal) {
    errno = refusal.get_native_error();
    return std::nullopt;
  }
}

std::optional<SegmentFile> SegmentFile::reopen(const std::string& path, Access access) {
  Descriptor opened(::open(path.c_str(), (access == Access::read_only ? O_RDONLY : O_RDWR) | O_CLOEXEC));
  if (opened.number() < 0) return std::nullopt;
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
