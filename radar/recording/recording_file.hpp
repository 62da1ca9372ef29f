// Header and index of a recording file. The header begins the file; the index and a trailer end it.
// Source: docs/recordings.md. Errors: see read_header(). A damaged index is no error: read_index() rebuilds it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/radar/fidelity.hpp"
#include "radar/recording/block.hpp"

namespace yars::recording {

// Configuration and terrain of the recorded model. A replay needs the same configuration and terrain.
struct RecordingHeader {
  std::string configuration;                  // path of the GUF file; empty = built-in configuration
  std::string terrain;                        // directory of cells; empty = the directory in the configuration
  std::uint32_t model = radar::kModelNumber;  // of the radar that made the sweeps; format version 3 has model 1
};

// Error if the radar model of this build is another one: it makes other sweeps from the recorded ticks.
error::Expected<void> check_model(const RecordingHeader& header, const std::string& file_name);

inline constexpr std::size_t kMaxHeaderText = std::size_t{1} << 16;  // [bytes] maximum length of a path

// The first bytes of a recording.
std::string_view file_magic();

// Header as stored: magic, version, kinds with versions and sizes, the paths, checksum.
std::vector<std::byte> bytes_of(const RecordingHeader& header);

// Reads the header. The position of `file` is then the first block. Errors, which all name `file_name`: another kind of
// file, another format version, a kind of record that this build does not know or knows with another version or size, a
// damaged or incomplete header.
error::Expected<RecordingHeader> read_header(std::istream& file, const std::string& file_name);

// Index entry of one block of items. When the writer closes the recording, it stores the index after the last of these
// blocks: a block of content `index`, then a trailer of 16 bytes with the offset of the index block.
// In a rebuilt index, damaged bytes between two blocks have an entry with kinds = 0 and the range of missing ticks.
struct IndexEntry {
  std::uint64_t offset;                // [bytes] offset of the block's head in the file
  std::int64_t first_tick, last_tick;  // lowest and highest tick of the items
  std::uint64_t kinds;                 // bit n: the block has items of kind n
};
static_assert(sizeof(IndexEntry) == 32);

struct RecordingIndex {
  std::vector<IndexEntry> blocks;
  bool cut_short = false;  // true: rebuilt, because the file does not end with a valid index
};

// Index block and trailer as stored at `offset` [bytes] of the file.
std::vector<std::byte> bytes_of(const std::vector<IndexEntry>& blocks, std::uint64_t offset, Compressor& compressor);

// Reads the index of a file with its first block at offset `begin`. Without a valid index, rebuilds it from the heads
// of the blocks, up to the last complete block. Memory is limited by the length of the file.
RecordingIndex read_index(std::istream& file, std::uint64_t begin);

}  // namespace yars::recording
