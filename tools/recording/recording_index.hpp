// Where the blocks of a recording lie and what is inside: written behind the last block when the recording is closed,
// a block of its own and a trailer of 16 bytes that says where it begins. A file without a whole one was cut short: the
// index is then made again from the heads of the blocks, up to the last whole one. Bytes between two of them that are
// none stand in it as a block of no kind, whose ticks are those that are missing.
// A block's sim time is its ticks times radar::kTickNanoseconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <vector>

#include "tools/recording/packing.hpp"

namespace yars::tools::recording {

struct IndexEntry {
  std::uint64_t offset;  // [bytes] of the block's head in the file
  std::int64_t first_tick, last_tick;
  std::uint64_t kinds;  // bit n: kind n is inside
};
static_assert(sizeof(IndexEntry) == 32);

struct RecordingIndex {
  std::vector<IndexEntry> blocks;
  bool cut_short = false;  // the file did not end with it
};

// What goes into the file at `offset` to end it.
std::vector<std::byte> bytes_of(const std::vector<IndexEntry>& blocks, std::uint64_t offset, Packer& packer);

// Of a file whose first block is at `begin`. Takes no more memory than the file is long.
RecordingIndex read_index(std::istream& file, std::uint64_t begin);

}  // namespace yars::tools::recording
