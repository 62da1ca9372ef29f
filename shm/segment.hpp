// Shared memory segment: header, layout identity, participation and claims by byte locks.
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

// The first bytes of every segment: what it is, so that a program of another build finds out before it touches
// anything else, and who holds which lock. The first 32 bytes keep their place in every layout version.
inline constexpr std::uint64_t kSegmentMagic = 0x314d485353524159U;  // "YARSSHM1" as bytes
inline constexpr std::size_t kLockBytes = 64;  // bytes of the file that serve as locks; byte 0: participation

struct SegmentHeader {
  std::atomic<std::uint64_t> magic;  // kSegmentMagic once the creator is done
  std::atomic<std::uint64_t> size;   // [bytes] of the whole segment
  std::atomic<std::uint64_t> hash;   // over (record, version, sizeof) of all records
  std::atomic<std::uint32_t> layout_version;
  std::atomic<std::uint32_t> reserved;
  std::array<std::atomic<std::int32_t>, kLockBytes>
      holder_pid;  // who locks byte n, for messages; the lock itself decides
  std::array<std::uint64_t, 4> reserved_words;
};
static_assert(sizeof(SegmentHeader) == 320 && std::atomic<std::int32_t>::is_always_lock_free);

// What a segment must be for this build to use it.
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

// The seam of the tests that kill a creator or a leaver after every single step: called, when set, behind each system
// call and each store by which a segment comes to be or goes. Nothing else uses it.
using CreationStep = void (*)(const char* what);
extern thread_local CreationStep creation_step;

// A named piece of shared memory, /dev/shm/yars.UID.NAME, that lives as long as somebody takes part in it.
// It is built whole without a name and linked to its own: nobody sees half a segment. Every participant holds
// a read lock on byte 0 of the file (F_OFD_SETLK), which the kernel frees at death; who gets the write lock is alone:
// leaving, it unlinks the file; arriving, it replaces a leftover. The other lock bytes are claims (roles, lanes).
// When somebody else removes the name (systemd-logind's RemoveIPC at a logout), those who take part go on, and who
// comes finds them by /proc and takes part too; has_name() tells. Errors: a full /dev/shm, a file of another user,
// another build's layout (both values are printed).
class Segment {
 public:
  // Fills the creator's zeroed memory behind the header, before anybody else can see it.
  using Initialize = void (*)(void* memory);

  // Attaches to the segment, or creates it. `name`: letters, digits, '-' and '_'.
  static error::Expected<Segment> open(const std::string& name, const LayoutIdentity& layout, Initialize initialize);
  // For readers: the mapping cannot be written, no lock is held. A leftover that nobody takes part in is an error.
  static error::Expected<Segment> open_read_only(const std::string& name, const LayoutIdentity& layout);

  Segment(Segment&&) noexcept;
  Segment& operator=(Segment&&) noexcept;
  ~Segment();  // gives up all locks; who leaves last unlinks

  void* memory();  // only of a writable segment
  const void* memory() const;
  bool writable() const;
  bool created() const;   // this process made it
  bool has_name() const;  // the segment's path leads to this segment

  // A claim on `byte` in [1, kLockBytes): held until unlock, the segment's end or the process's death, also while the
  // process is stopped. Within one Segment a byte can be held once.
  bool try_lock(std::size_t byte);
  void unlock(std::size_t byte);
  bool is_locked(std::size_t byte) const;           // by anybody, this process included
  std::int32_t holder_pid(std::size_t byte) const;  // who locked it last and did not unlock it; 0 = nobody

 private:
  struct Core;
  explicit Segment(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

// Where the segment of a name lies: /dev/shm/yars.UID.NAME.
std::string segment_path(const std::string& name);

}  // namespace yars::shm
