// Reader of a recording file: returns items in the order of recording, from the beginning or from any block.
// Errors: open() and read() fail for an unreadable header. A damaged block is skipped and listed by missing(). A file
// that was cut short can be read up to its last complete block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/error/error.hpp"
#include "radar/recording/block.hpp"
#include "radar/recording/recorded_kinds.hpp"
#include "radar/recording/recording_file.hpp"

namespace yars::recording {

class RecordingReader {
 public:
  // Errors: not a recording, records of another release, a damaged or incomplete header. open() also fails if the path
  // does not lead to a regular file that can be read. `name`: file name for messages.
  static error::Expected<RecordingReader> open(const std::filesystem::path& path);
  static error::Expected<RecordingReader> read(std::unique_ptr<std::istream> file, const std::string& name);

  const RecordingHeader& header() const { return header_; }
  // Next item; nullopt at the end. Skips damaged blocks.
  std::optional<RecordingItem> next();
  // True once after next() has skipped a damaged block (a hole): items are missing before the item just returned.
  bool take_damage_flag() { return std::exchange(hole_, false); }

  // next() then returns the first item of this block or, if it is damaged, of the next undamaged block.
  // `block` in [0, blocks().size()]; at the upper limit next() returns nullopt.
  void seek_block(std::size_t block);
  // Number of the first block that contains this tick, else of the last block that begins before it, else 0. Several
  // blocks may contain a tick, because ticks go back when the session is reset.
  std::size_t block_of(std::int64_t tick) const;
  // Items of one block; nullopt if the block is damaged. Does not change the position of next().
  std::optional<BlockItems> items_of(std::size_t block);
  // The block as stored in the file, head and body; empty if it is damaged. Does not change the position of next().
  std::vector<std::byte> bytes_of_block(std::size_t block);
  // Last item of type T in the undamaged blocks before the current block, such as the radar state that is in force
  // when the current block begins. The current block is the block that next() reads, or will read after a seek. nullopt
  // if there is no such item.
  template <class T>
  std::optional<T> last_before() {
    const auto item = last_before(kKindOf<T>.number);
    return item ? std::optional<T>(std::get<T>(*item)) : std::nullopt;
  }

  std::span<const IndexEntry> blocks() const { return index_.blocks; }
  // True if the file has no valid index at its end, as when the recorder did not close it, or if a damaged block was
  // found so far.
  bool cut_short() const { return index_.cut_short || !missing_.empty(); }
  // Damaged blocks found so far, in order of their offset in the file.
  const std::vector<IndexEntry>& missing() const { return missing_; }

 private:
  std::optional<RecordingItem> last_before(std::uint8_t kind);
  std::optional<BlockItems> undamaged_block(std::size_t block);  // nullopt if damaged; adds a damaged block to missing_
  std::optional<BlockItems> block_at(std::uint64_t offset);      // nullopt if damaged
  std::vector<std::byte> bytes_at(std::uint64_t offset);         // head and body; empty if damaged

  std::unique_ptr<std::istream> file_;
  RecordingHeader header_;
  RecordingIndex index_;
  std::size_t next_block_ = 0;
  std::optional<BlockItems> block_;  // the block that next() reads
  std::vector<IndexEntry> missing_;
  bool hole_ = false;
};

}  // namespace yars::recording
