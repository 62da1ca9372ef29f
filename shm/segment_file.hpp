// The file behind a segment: opened, locked, mapped and linked through Boost.Interprocess and the system's own calls.
// One open file description each, so that locks belong to the object and not to the process. For segment.cpp.
#pragma once

#include <sys/stat.h>

#include <boost/interprocess/mapped_region.hpp>
#include <boost/interprocess/shared_memory_object.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace yars::shm {

enum class LockKind { none, read, write };

class SegmentFile {
 public:
  enum class Access { read_only, read_write };
  // Both: nullopt with errno set when the system refuses; creating fails with EEXIST when the name is taken.
  static std::optional<SegmentFile> open(const std::string& file_name, Access access);
  static std::optional<SegmentFile> create(const std::string& file_name);
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
  class Descriptor {
   public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept;
    ~Descriptor();
    int number() const { return number_; }

   private:
    int number_;
  };

  SegmentFile(boost::interprocess::shared_memory_object object, Access access);
  SegmentFile(Descriptor reopened, Access access);
  int descriptor() const { return reopened_.number() >= 0 ? reopened_.number() : object_.get_mapping_handle().handle; }

  boost::interprocess::shared_memory_object object_;  // opened by its name, else
  Descriptor reopened_;                               // without one
  boost::interprocess::mapped_region region_;
  Access access_;
};

}  // namespace yars::shm
