// File behind a segment: opened, locked, mapped, linked; found again when its name was removed.
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

// Files that processes of this user hold open though their name is gone from /dev/shm: somebody else removed it, as
// systemd-logind does at a user's logout (RemoveIPC=yes). What is mapped goes on; this finds the way back in.

// Paths /proc/PID/fd/N that open files which had the name `path`, or the name under which a creator built it
// (path.NUMBER.tmp), and have none now; regular files of this user alone. Looks at every process that this user may
// look into; a few milliseconds.
std::vector<std::string> nameless_files(const std::string& path);

// The file behind a segment: opened, locked, mapped and linked through Boost.Interprocess and the system's own calls.
// One open file description each, so that locks belong to the object and not to the process. For segment.cpp.
enum class LockKind { none, read, write };

class SegmentFile {
 public:
  enum class Access { read_only, read_write };
  // Both: nullopt with errno set when the system refuses.
  static std::optional<SegmentFile> open(const std::string& file_name, Access access);
  // Without a name (O_TMPFILE), so that nothing planted can stand in its way and a creator that dies leaves nothing;
  // where the system cannot do that, under `file_name`.NUMBER.tmp with a random number.
  static std::optional<SegmentFile> create(const std::string& file_name);
  // Gives a new file its name; false with errno set: EEXIST, somebody else has it. Of its locks byte 0 stays, for
  // reading.
  bool link_as(const std::string& file_name);
  // Takes the temporary name away, if it has one.
  void remove_temporary();
  // Opens what a descriptor of some process has open: `path` is /proc/PID/fd/N.
  static std::optional<SegmentFile> reopen(const std::string& path, Access access);

  bool lock(std::size_t byte, LockKind kind);     // false: somebody else's lock is in the way
  bool could_write_lock(std::size_t byte) const;  // nobody else holds a lock there
  int allocate(std::uint64_t size);               // 0 or an errno value; takes the memory for good
  bool map();                                     // the whole file; false with errno set
  struct stat status() const;
  bool is_at(const std::string& path) const;  // the path leads to this very file
  void* memory() { return region_.get_address(); }
  const void* memory() const { return region_.get_address(); }
  std::uint64_t size() const { return region_.get_size(); }

 private:
  SegmentFile(file::Descriptor descriptor, Access access) : descriptor_(std::move(descriptor)), access_(access) {}
  int descriptor() const { return descriptor_.number(); }

  file::Descriptor descriptor_;
  std::string temporary_;  // its name until it is linked; empty: it has none
  boost::interprocess::mapped_region region_;
  Access access_;
};

}  // namespace yars::shm
