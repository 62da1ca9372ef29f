// Progress of records that come from other hosts, kept in the segment for the next gateway (databuffer RemoteProgress).
// Inputs: number of a record at its source; number of records in the local container before it is written.
// Errors: numbers are kept with 32 and 27 bits. A source that is 2^31 records ahead of its entry is taken for another
//   place; so is a container to which others have added a multiple of 2^27 records.
// A gateway killed at any point leaves an entry from which the next one continues without gap or repetition.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string_view>

#include "databuffer/session/session_layout.hpp"
#include "gateway/host_id.hpp"

namespace yars::gateway {

// Name of a container of another host: FNV-1a over the bytes of the numbers; not 0.
inline std::uint64_t source_id(std::initializer_list<std::uint64_t> numbers) {
  const std::string_view bytes(reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(std::uint64_t));
  return std::max<std::uint64_t>(host_id(bytes), 1);
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
  return ((local - progress) & kLocalMask) <= 1;
}

// Number of the next record to take, according to an entry. `local`: number of records in the container now. `near`: a
// number less than 2^31 away from the result.
inline std::uint64_t next_of(std::uint64_t progress, std::uint64_t local, std::uint64_t near) {
  const auto difference = static_cast<std::int32_t>(static_cast<std::uint32_t>((progress >> 32) - near));
  const std::uint64_t next = near + static_cast<std::uint64_t>(std::int64_t{difference});
  const bool is_missing = ((local - progress) & kLocalMask) == 0;
  return is_missing ? next - 1 : next;
}

// Entry of a source in a table; nullptr: it has none.
template <class Entries>
auto find_entry(Entries& entries, std::uint64_t source) {
  const auto found =
      std::ranges::find_if(entries, [source](const auto& entry) { return entry.source.load() == source; });
  return found == entries.end() ? nullptr : &*found;
}

// The entry to write: that of the source, else a free one, else one of a source that is not known, else the one at
// `source % size`.
template <class Entries>
databuffer::RemoteProgress& entry_of(
    Entries& entries, std::uint64_t source,
    const std::function<bool(std::uint64_t)>& is_known = [](auto) { return true; }) {
  for (const std::uint64_t wanted : {source, std::uint64_t{0}})
    if (auto* entry = find_entry(entries, wanted)) return *entry;
  const auto unknown =
      std::ranges::find_if(entries, [&is_known](const auto& entry) { return !is_known(entry.source.load()); });
  return unknown != entries.end() ? *unknown : entries[source % entries.size()];
}

// Writes an entry. Call it before the record is written in the local container.
inline void store_progress(databuffer::RemoteProgress& entry, std::uint64_t source, std::uint64_t progress) {
  if (entry.source.load() != source) entry.source.store(0);
  entry.progress.store(progress);
  entry.source.store(source);
}

}  // namespace yars::gateway
