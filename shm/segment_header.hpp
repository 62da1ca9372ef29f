// The first bytes of every segment: what it is, so that a program of another build finds out before it touches
// anything else, and who holds which lock. The first 32 bytes keep their place in every layout version.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace yars::shm {

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

}  // namespace yars::shm
