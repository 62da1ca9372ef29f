// How a recording file begins and ends: header with the kinds, index of the blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "tools/recording/compression.hpp"

namespace yars::tools::recording {

// The begin of a recording: magic and version, the kinds of records with their sizes, what the model ran with, and a
// checksum. A recording whose records differ from this build's is refused, not misread.

// With what the model ran; replay needs the same.
struct RecordingHeader {
  std::string configuration;  // path of the GUF file; empty = built-in
  std::string terrain;        // directory; empty = the configuration's
};

inline constexpr std::size_t kMaxHeaderText = std::size_t{1} << 16;  // [bytes] of a path

std::vector<std::byte> bytes_of(const RecordingHeader& header);

// Reads it and leaves `file` behind it. Errors name `file_name`: another kind of file, another version, a record of
// another size or meaning, a header that is damaged or not whole.
error::Expected<RecordingHeader> read_header(std::istream& file, const std::string& file_name);

// Where the blocks of a recording lie and what is inside: written behind the last block when the recording is closed,
// a block of its own and a trailer of 16 bytes that says where it begins. A file without a whole one was cut short: the
// index is then made again from the heads of the blocks, up to the last whole one. Bytes between two of them that are
// none stand in it as a block of no kind, whose ticks are those that are missing.
// A block's sim time is its ticks times radar::kTickNanoseconds.
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
