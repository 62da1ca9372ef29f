// Reads a recording, item by item in the order in which they were recorded, from its begin or from any block. A file
// that was cut short plays to its last whole block; a block that is damaged costs that block.
#pragma once

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
#include "tools/recording/block.hpp"
#include "tools/recording/recorded_kinds.hpp"
#include "tools/recording/recording_file.hpp"

namespace yars::tools::recording {

class RecordingReader {
 public:
  // An error: no file, another kind of file, another release's records, no whole header.
  static error::Expected<RecordingReader> open(const std::filesystem::path& path);
  static error::Expected<RecordingReader> read(std::unique_ptr<std::istream> file, std::string name);

  const RecordingHeader& header() const { return header_; }
  // Nothing at the end. Damaged blocks are passed over: see missing().
  std::optional<RecordingItem> next();
  // True once after next() has passed over a block: what came before and what comes now do not join.
  bool take_hole() { return std::exchange(hole_, false); }

  // The next item is then the first of a block: the first block with this tick inside, else the last block that begins
  // before it, else the first block. Ticks may begin anew within a recording, when the session is reset.
  void seek_tick(std::int64_t tick) { seek_block(block_of(tick)); }
  void seek_time(std::int64_t sim_time_ns);
  // The same by number, 0 to blocks().size().
  void seek_block(std::size_t block);
  std::size_t block_of(std::int64_t tick) const;
  // What is in one block; the reading under way goes on where it was. Nothing when it is damaged.
  std::optional<BlockItems> items_of(std::size_t block);
  // The last item of type T before the block that comes next, of those that are whole: with what the radar was set to
  // where it begins. Nothing when there is none.
  template <class T>
  std::optional<T> last_before() {
    const auto item = last_before(kKindOf<T>.number);
    return item ? std::optional<T>(std::get<T>(*item)) : std::nullopt;
  }

  std::span<const IndexEntry> blocks() const { return index_.blocks; }
  // The recorder did not come to its end, or what it wrote was damaged since: not all that was recorded can be read.
  bool cut_short() const { return index_.cut_short || !missing_.empty(); }
  // The damaged blocks met so far, by their place in the file; the first of them as an error.
  const std::vector<IndexEntry>& missing() const { return missing_; }
  const std::optional<error::Error>& damage() const { return damage_; }

 private:
  std::optional<RecordingItem> last_before(std::uint8_t kind);
  std::optional<BlockItems> whole_block(std::size_t block);  // nothing when it is damaged, which is then told
  error::Expected<BlockItems> block_at(std::uint64_t offset);

  std::unique_ptr<std::istream> file_;
  std::string name_;
  RecordingHeader header_;
  RecordingIndex index_;
  std::size_t next_block_ = 0;
  std::optional<BlockItems> block_;  // the one under way
  std::optional<error::Error> damage_;
  std::vector<IndexEntry> missing_;
  bool hole_ = false;
};

}  // namespace yars::tools::recording
