// Named shared memory segment: header, layout identity, participation and claims by byte locks.
// Inputs: a name ([A-Za-z0-9_-]), the layout identity of this build, a function that fills new memory.
// Outputs: the mapped memory of /dev/shm/yars.UID.NAME; claims on its lock bytes.
// Errors: /dev/shm is full, the file belongs to another user, or another build made it. Messages name both values.
// Threads: locks belong to the Segment object; the kernel releases them when the process ends.
// Source: docs/shared_memory.md.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "lib/error/error.hpp"

namespace yars::shm {

// First bytes of every segment. They identify its layout, so that a program of another build stops before it touches
// anything else. The first 32 bytes keep their offsets in every layout version.
inline constexpr std::uint64_t kSegmentMagic = 0x314d485353524159U;  // "YARSSHM1" as bytes
inline constexpr std::size_t kLockBytes = 64;                        // lock bytes of the file; byte 0: participation

struct SegmentHeader {
  std::atomic<std::uint64_t> magic;  // kSegmentMagic once creation is complete
  std::atomic<std::uint64_t> size;   // [bytes] of the whole segment
  std::atomic<std::uint64_t> hash;   // over (record, version, sizeof) of all records
  std::atomic<std::uint32_t> layout_version;
  std::atomic<std::uint32_t> reserved;
  std::array<std::atomic<std::int32_t>, kLockBytes>
      holder_pid;  // process that locks byte n, for messages; only the lock decides
  std::array<std::uint64_t, 4> reserved_words;
};
static_assert(sizeof(SegmentHeader) == 320 && std::atomic<std::int32_t>::is_always_lock_free);

// Layout that a segment must have for this build to use it.
struct LayoutIdentity {
  std::uint32_t version;
  std::uint64_t size;  // [bytes]
  std::uint64_t hash;
};

struct RecordIdentity {
  std::string_view name;
  std::uint32_t version;
  std::uint64_t size;  // [bytes]
};

// FNV-1a 64 over the records' names, versions and sizes, in order.
constexpr std::uint64_t layout_hash(std::span<const RecordIdentity> records) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto mix = [&hash](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) hash = (hash ^ ((value >> (8 * i)) & 0xffU)) * 0x100000001b3U;
  };
  for (const RecordIdentity& record : records) {
    for (const char letter : record.name) mix(static_cast<unsigned char>(letter), 1);
    mix(0, 1);
    mix(record.version, 4);
    mix(record.size, 8);
  }
  return hash;
}

// Test hook: called after each system call and each store that creates or removes a segment. Tests use it to kill the
// process at that step. Product code leaves it null.
using CreationStep = void (*)(const char* what);
extern thread_local CreationStep creation_step;

// Segment of shared memory that exists while at least one process takes part in it.
// It is built without a name and linked when complete, so no process sees a partial segment.
// Every participant holds a read lock on byte 0 of the file (F_OFD_SETLK). The kernel releases it at process death. A
// process that obtains the write lock is alone: on leaving it unlinks the file, on arrival it replaces a leftover file.
// The other lock bytes are claims on roles and lanes.
// If another program removes the name (systemd-logind with RemoveIPC at logout), participants continue. New
// participants find the file through /proc, and has_name() returns false.
class Segment {
 public:
  // Fills the creator's zeroed memory after the header, before any other process can map it.
  using Initialize = void (*)(void* memory);

  // Attaches to the segment, or creates it. `name`: letters, digits, '-' and '_'.
  static error::Expected<Segment> open(const std::string& name, const LayoutIdentity& layout, Initialize initialize);
  // Maps the segment read-only and holds no lock. A leftover without participants is an error.
  static error::Expected<Segment> open_read_only(const std::string& name, const LayoutIdentity& layout);

  Segment(Segment&&) noexcept;
  Segment& operator=(Segment&&) noexcept;
  ~Segment();  // releases all locks; the last participant unlinks the file

  void* memory();  // requires a writable segment
  const void* memory() const;
  bool writable() const;
  bool created() const;   // this object created the segment
  bool has_name() const;  // the segment's path leads to this segment

  // Claims `byte` in [1, kLockBytes) until unlock(), the end of the segment or process death. A stopped process keeps
  // its claim. Within one Segment a byte can be held once.
  bool try_lock(std::size_t byte);
  void unlock(std::size_t byte);
  bool is_locked(std::size_t byte) const;           // by any process, this one included
  std::int32_t holder_pid(std::size_t byte) const;  // last process that locked it and did not unlock it; 0: none

 private:
  struct Core;
  explicit Segment(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

// Path of the segment with this name: /dev/shm/yars.UID.NAME.
std::string segment_path(const std::string& name);

}  // namespace yars::shm
