// Named shared memory segment with a header that identifies its layout. Locks on bytes of its file mark participants
// and claims. A claim is the exclusive right to one role or lane of the session.
// Inputs: a name ([A-Za-z0-9_-]), the layout identity of this build, a function that initializes new memory.
// Outputs: the mapped memory of /dev/shm/yars.UID.NAME; claims on its lock bytes.
// Errors: /dev/shm is full, the file belongs to another user, or its layout is not that of this build.
// Threads: locks belong to the Segment object. The operating system releases them when the process ends.
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

// First 8 bytes of every segment.
inline constexpr std::uint64_t kSegmentMagic = 0x314d485353524159U;  // "YARSSHM1" as bytes
inline constexpr std::size_t kLockBytes = 64;                        // number of lock bytes; byte 0 marks participants

// Header of a segment. It identifies the layout: a program with another layout stops before it reads anything else.
// The first 32 bytes have the same layout in every version.
struct SegmentHeader {
  std::atomic<std::uint64_t> magic;  // kSegmentMagic once creation is complete
  std::atomic<std::uint64_t> size;   // [bytes] size of the segment
  std::atomic<std::uint64_t> hash;   // layout_hash() of all record types
  std::atomic<std::uint32_t> layout_version;
  std::atomic<std::uint32_t> reserved;
  // Process id of the holder of each lock byte, for error messages only. Only the lock shows that a byte is held.
  std::array<std::atomic<std::int32_t>, kLockBytes> holder_pid;
  std::array<std::uint64_t, 4> reserved_words;
};
static_assert(sizeof(SegmentHeader) == 320 && std::atomic<std::int32_t>::is_always_lock_free);

// Layout that a segment must have for this build to use it.
struct LayoutIdentity {
  std::uint32_t version;
  std::uint64_t size;  // [bytes]
  std::uint64_t hash;
};

// One record type of the layout, for layout_hash().
struct RecordIdentity {
  std::string_view name;
  std::uint32_t version;
  std::uint64_t size;  // [bytes]
};

// 64-bit hash FNV-1a over the records' names, versions and sizes, in order.
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

// Test hook, called after each step (system call or store) that creates or removes a segment.
// Tests use it to kill the process at that step. Elsewhere it is null.
using CreationStep = void (*)(const char* what);
extern thread_local CreationStep creation_step;

// Shared memory segment that exists while at least one process participates in it.
// The creator fills a file without a name and then links the file to the name. No process sees a partial segment.
// Every participant holds a read lock on byte 0 of the file (F_OFD_SETLK). The operating system releases the lock when
// the process dies.
// A process that obtains the write lock on byte 0 is alone. A leaving process then unlinks the file. An arriving
// process has then found a leftover of dead processes, and replaces it.
// The other lock bytes are claims on roles and lanes.
// If another program removes the name (systemd-logind with RemoveIPC at logout), participants continue.
// has_name() then returns false. New participants find the file through /proc.
class Segment {
 public:
  // Initializes the zeroed memory after the header. `memory` is the start of the segment, where the header will be.
  // The creator calls this function before any other process can map the memory.
  using Initialize = void (*)(void* memory);

  // Joins the segment, or creates it. `name`: letters, digits, '-' and '_'.
  static error::Expected<Segment> open(const std::string& name, const LayoutIdentity& layout, Initialize initialize);
  // Joins the segment that programs have made; creates, removes and waits for nothing. Errors: no segment; a leftover
  // without participants; a segment that is just ending, of another user, or with another layout.
  static error::Expected<Segment> join(const std::string& name, const LayoutIdentity& layout);
  // Maps the segment read-only, without participating. Errors: no segment; a leftover without participants; a segment
  // of another user or with another layout.
  static error::Expected<Segment> open_read_only(const std::string& name, const LayoutIdentity& layout);

  Segment(Segment&&) noexcept;
  Segment& operator=(Segment&&) noexcept;
  ~Segment();  // releases all locks; the last participant unlinks the file

  void* memory();  // requires a writable segment
  const void* memory() const;
  bool writable() const;
  bool created() const;   // this object created the segment
  bool has_name() const;  // true if the segment's path leads to this segment

  // Claims `byte` in [1, kLockBytes) until unlock(), destruction of the Segment, or process death.
  // A stopped (SIGSTOP) process keeps its claim. False: this or another Segment holds the byte, or this is read-only.
  bool try_lock(std::size_t byte);
  void unlock(std::size_t byte);                    // no effect if this object does not hold the byte
  bool is_locked(std::size_t byte) const;           // true if this or another process holds the byte
  std::int32_t holder_pid(std::size_t byte) const;  // last process that locked the byte without unlocking; 0: none

 private:
  struct Core;
  explicit Segment(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

}  // namespace yars::shm
