// Progress of records that come from other hosts, kept in the segment for the next gateway (databuffer RemoteProgress).
// Inputs: number of a record at its source; number of records in the local container before it is written.
// Errors: numbers are kept with 32 and 27 bits. A source that is 2^31 records ahead of its entry is taken for another
//   place; so is a container to which others have added a multiple of 2^27 records.
// A gateway killed at any point leaves an entry from which the next one continues without a gap and without a
//   repetition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "databuffer/session/session_layout.hpp"

namespace yars::gateway {

// Name of a container of another host: FNV-1a over the numbers; not 0.
inline std::uint64_t source_id(std::initializer_list<std::uint64_t> numbers) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::uint64_t number : numbers)
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (number >> (8 * byte) & 0xFFU)) * 0x100000001b3U;
  return hash == 0 ? 1 : hash;
}

inline constexpr std::uint64_t kLocalMask = 0x07FF'FFFFU;

// Entry before record number `next - 1` is written as record `local` of lane `lane` here (0 for a ring).
inline std::uint64_t progress_of(std::uint64_t next, std::uint64_t local, std::size_t lane = 0) {
  return next << 32 | std::uint64_t{lane & 0x1FU} << 27 | (local & kLocalMask);
}
inline std::size_t lane_of(std::uint64_t progress) {
  return progress >> 27 & 0x1FU;
}

// True if a container with `local` records ends with the last record of an entry, or still lacks it.
inline bool ends_with(std::uint64_t progress, std::uint64_t local) {
  const std::uint64_t since = (local - progress) & kLocalMask;
  return since <= 1;
}

// Number of the next record to take, according to an entry. `local`: number of records in the container now. `near`: a
// number less than 2^31 away from the result.
inline std::uint64_t next_of(std::uint64_t progress, std::uint64_t local, std::uint64_t near) {
  const auto difference = static_cast<std::int32_t>(static_cast<std::uint32_t>((progress >> 32) - near));
  const std::uint64_t next = near + static_cast<std::uint64_t>(std::int64_t{difference});
  const bool is_missing = ((local - progress) & kLocalMask) == 0;
  return is_missing ? next - 1 : next;
}

// Entry of a source in the table of one history: its own, else a free one, else the one at `source % size`.
template <class Entries>
databuffer::RemoteProgress& entry_of(Entries& entries, std::uint64_t source) {
  databuffer::RemoteProgress* free = nullptr;
  for (databuffer::RemoteProgress& entry : entries) {
    if (entry.source.load() == source) return entry;
    if (free == nullptr && entry.source.load() == 0) free = &entry;
  }
  return free != nullptr ? *free : entries[source % entries.size()];
}

// Writes an entry. Call it before the record is written in the local container.
inline void store_progress(databuffer::RemoteProgress& entry, std::uint64_t source, std::uint64_t progress) {
  if (entry.source.load() != source) entry.source.store(0);
  entry.progress.store(progress);
  entry.source.store(source);
}

}  // namespace yars::gateway
