// Reader and writer of a recording file: a header, then blocks of about one second, then an index.
// The reader returns items in the order of recording, from the beginning or from any block. The writer collects items
// in memory until one second of sim time has passed or the block is full. It then compresses the block and writes it at
// once, which takes some milliseconds.
// Errors: open() and read() fail for an unreadable header. A damaged block is skipped and listed by missing(). A file
// that was cut short or not closed can be read up to its last complete block. A write that fails loses its block, and
// no part of that block stays in the file. Once check_place() or close() has found that the file was removed or
// renamed, nothing more is written to it.
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
#include "lib/file/output_file.hpp"
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

using file::Existing;  // what to do with an existing regular file at the path of the recording

// True if a RecordingWriter of any process has the file open. It holds a lock of its open file description.
bool is_being_written(const std::filesystem::path& path);

class RecordingWriter {
 public:
  // Creates the file with mode 0600 and writes the header. Errors: the file exists (`Existing::refused`), is a symbolic
  // link or cannot be created, or a path of the header is too long.
  // On a full disk create() succeeds, and the first append() fails.
  static error::Expected<RecordingWriter> create(const std::filesystem::path& path, const RecordingHeader& header,
                                                 Existing existing = Existing::refused);

  // Appends a record of one of the types of RecordingItem. Errors: a write failed, usually on a full disk. append(),
  // flush() and close() then return this error until resume() succeeds.
  template <class T>
  error::Expected<void> append(const T& record) {
    return append(*recorded_kind(kKindOf<T>.number), parts_of(record), tick_of(record));
  }
  // Writes the collected items, then a block of another recording as stored there. `entry`: its index entry there.
  error::Expected<void> append_block(const std::vector<std::byte>& block, const IndexEntry& entry);
  // Writes the collected items as a block.
  error::Expected<void> flush();
  // After an error: drops the collected items and continues after the last complete block. Begins a new file if the
  // present one was removed, renamed or set aside. Fails if the disk is still full, or if a file still
  // cannot be renamed or created.
  error::Expected<void> resume();
  // Error: the file was removed or renamed, or its folder was.
  error::Expected<void> check_place();
  // True if the file is open, and its path leads to it.
  bool is_at_path() const;
  // Writes the collected items and the index, and closes the file.
  error::Expected<void> close();
  // Closes the file, renames it to FILE.before, replacing an older FILE.before, and creates FILE again.
  error::Expected<void> begin_next();

  std::uint64_t bytes() const { return bytes_; }  // size of the file
  std::uint64_t files() const { return files_; }  // number of files begun

 private:
  RecordingWriter(std::shared_ptr<const file::Folder> folder, std::string name, RecordingHeader header)
      : folder_(std::move(folder)), name_(std::move(name)), header_(std::move(header)) {}
  error::Expected<void> append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick);
  error::Expected<void> write(const std::vector<std::byte>& bytes);
  error::Expected<void> begin_file(Existing existing);
  error::Expected<void> set_aside();
  bool write_header();
  tl::unexpected<error::Error> write_failed(int error_number);

  int descriptor() const { return file_ ? file_->descriptor() : -1; }

  std::shared_ptr<const file::Folder> folder_;
  std::string name_;
  RecordingHeader header_;
  std::optional<file::NewFile> file_;
  BlockBuilder block_;
  Compressor compressor_;
  std::vector<IndexEntry> blocks_;
  std::uint64_t bytes_ = 0;
  std::uint64_t files_ = 0;
  bool set_aside_due_ = false;  // the file is closed and still has to be renamed to FILE.before
  std::optional<error::Error> error_;
};

}  // namespace yars::recording
