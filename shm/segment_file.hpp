// File of a shared memory segment: opens, locks, maps and links the file, and finds it again without its name.
// Inputs: file names in /dev/shm, or descriptor paths /proc/PID/fd/N.
// Errors: a function returns std::nullopt, false or an errno value. errno is set where stated.
// Threads: locks belong to the open file description (F_OFD_SETLK), not to the process. An open file description is the
// operating system's object behind a descriptor.
#pragma once

#include <sys/stat.h>

#include <boost/interprocess/mapped_region.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/file/folder.hpp"

namespace yars::shm {

inline constexpr const char* kSegmentFolder = "/dev/shm";  // glibc's shm_open and Boost keep their objects here

inline std::string path_of(const std::string& file_name) {
  return std::string(kSegmentFolder) + "/" + file_name;
}

// Finds open files that have lost their name, and returns their paths /proc/PID/fd/N. The lost name is `path`, or a
// creator's temporary name path.NUMBER.tmp. Names are lost when another program unlinks them, as systemd-logind does at
// logout with RemoveIPC=yes. Only regular files of this user are returned. The search covers all processes that this
// user may inspect and takes a few milliseconds.
std::vector<std::string> nameless_files(const std::string& path);

enum class LockKind { none, read, write };

// Open file of a segment, mapped through Boost.Interprocess. Each object has its own open file description, so that
// locks belong to the object. Only segment.cpp and tests use this class.
class SegmentFile {
 public:
  enum class Access { read_only, read_write };
  // open(), create() and reopen(): nullopt with errno set on failure.
  static std::optional<SegmentFile> open(const std::string& file_name, Access access);
  // Creates a file without a name (O_TMPFILE). It disappears if its creator dies. Where the system has no O_TMPFILE,
  // the file has the name `file_name`.NUMBER.tmp with a random number.
  static std::optional<SegmentFile> create(const std::string& file_name);
  // Gives a new file its name. False with errno set; EEXIST means that the name is taken. The file is opened again by
  // this name, and only the read lock on byte 0 moves to the new open file description. Lock other bytes afterwards.
  bool link_as(const std::string& file_name);
  void remove_temporary();  // unlinks the temporary name, if there is one
  // Opens the file behind a descriptor of another process; `path` is /proc/PID/fd/N.
  static std::optional<SegmentFile> reopen(const std::string& path, Access access);

  bool lock(std::size_t byte, LockKind kind);     // never waits; false: a lock of another description conflicts
  bool could_write_lock(std::size_t byte) const;  // true if no other description holds a lock on the byte
  int allocate(std::uint64_t size);               // reserves `size` bytes of memory; returns 0 or an errno value
  bool map();                                     // maps the complete file; false with errno set
  struct stat status() const;
  bool is_at(const std::string& path) const;  // true if the path leads to this file
  void* memory() { return region_.get_address(); }
  const void* memory() const { return region_.get_address(); }
  std::uint64_t size() const { return region_.get_size(); }

 private:
  SegmentFile(file::Descriptor descriptor, Access access) : descriptor_(std::move(descriptor)), access_(access) {}
  int descriptor() const { return descriptor_.number(); }

  file::Descriptor descriptor_;
  std::string temporary_;  // temporary name until the file is linked; empty: the file has none
  boost::interprocess::mapped_region region_;
  Access access_;
};

}  // namespace yars::shm
