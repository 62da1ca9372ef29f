// Reads a recording, item by item in the order in which they were recorded, from its begin or from any block. A file
// that was cut short plays to its last whole block; a block with a wrong checksum ends it too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "lib/failure/error.hpp"
#include "tools/recording/block_items.hpp"
#include "tools/recording/recorded_kinds.hpp"
#include "tools/recording/recording_header.hpp"
#include "tools/recording/recording_index.hpp"

namespace yars::tools::recording {

class RecordingReader {
 public:
  // An error: no file, another kind of file, another release's records, no whole header.
  static failure::Expected<RecordingReader> open(const std::filesystem::path& path);
  static failure::Expected<RecordingReader> read(std::unique_ptr<std::istream> file, std::string name);

  const RecordingHeader& header() const { return header_; }
  // Nothing at the end, and from a damaged block on, until a seek.
  std::optional<RecordingItem> next();

  // The next item is then the first of a block: the first block with this tick inside, else the last block that begins
  // before it, else the first block. Ticks may begin anew within a recording, when the session is reset.
  void seek_tick(std::int64_t tick) { seek_block(block_of(tick)); }
  void seek_time(std::int64_t sim_time_ns);
  // The same by number, 0 to blocks().size().
  void seek_block(std::size_t block);
  std::size_t block_of(std::int64_t tick) const;
  // What is in one block; the reading under way goes on where it was. Nothing when it is damaged.
  std::optional<BlockItems> items_of(std::size_t block);
  // The last item of type T before the block that comes next: with what the radar was set to where it begins. Nothing
  // when there is none, or its block is damaged.
  template <class T>
  std::optional<T> last_before() {
    const auto item = last_before(kKindOf<T>.number);
    return item ? std::optional<T>(std::get<T>(*item)) : std::nullopt;
  }

  std::span<const IndexEntry> blocks() const { return index_.blocks; }
  // The recorder did not come to its end, or what it wrote was damaged since: not all that was recorded can be read.
  bool cut_short() const { return index_.cut_short || damage_.has_value(); }
  const std::optional<failure::Error>& damage() const { return damage_; }  // the block at which next() last ended

 private:
  std::optional<RecordingItem> last_before(std::uint8_t kind);
  failure::Expected<BlockItems> block_at(std::uint64_t offset);

  std::unique_ptr<std::istream> file_;
  std::string name_;
  RecordingHeader header_;
  RecordingIndex index_;
  std::size_t next_block_ = 0;
  std::optional<BlockItems> block_;  // the one under way
  std::optional<failure::Error> damage_;
  bool ended_ = false;  // by damage
};

}  // namespace yars::tools::recording
