// Writes a recording: a header, then blocks of about a second, then an index. Items are gathered in memory until a
// second of sim time is over or some megabytes are there; the block is then packed and written in one piece, some
// milliseconds. What was written reads back, whatever becomes of the writer: a file that was not closed ends at its
// last whole block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "lib/failure/error.hpp"
#include "lib/file/new_file.hpp"
#include "tools/recording/block_builder.hpp"
#include "tools/recording/recorded_kinds.hpp"
#include "tools/recording/recording_header.hpp"
#include "tools/recording/recording_index.hpp"

namespace yars::tools::recording {

class RecordingWriter {
 public:
  // Replaces a file of this name; it is the user's alone (0600). An error: it is a link, it cannot be written, or the
  // header does not fit.
  static failure::Expected<RecordingWriter> create(const std::filesystem::path& path, const RecordingHeader& header);

  // `T`: one of RecordingItem's. An error: the disk took no more; so do all calls after the first. What is in the file
  // by then reads back.
  template <class T>
  failure::Expected<void> append(const T& record) {
    return append(*recorded_kind(kKindOf<T>.number), parts_of(record), tick_of(record));
  }
  // Writes what has been gathered, so that a reader finds it.
  failure::Expected<void> flush();
  // And the index: the recording is then whole.
  failure::Expected<void> close();

  std::uint64_t bytes() const { return bytes_; }  // in the file

 private:
  RecordingWriter(std::filesystem::path path, file::NewFile file) : path_(std::move(path)), file_(std::move(file)) {}
  failure::Expected<void> append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick);
  failure::Expected<void> write(const std::vector<std::byte>& bytes);

  std::filesystem::path path_;
  file::NewFile file_;
  BlockBuilder block_;
  Packer packer_;
  std::vector<IndexEntry> blocks_;
  std::uint64_t bytes_ = 0;
  std::optional<failure::Error> error_;
};

}  // namespace yars::tools::recording
