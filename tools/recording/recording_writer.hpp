// Writes a recording: a header, then blocks of about a second, then an index. Items are gathered in memory until a
// second of sim time is over or some megabytes are there; the block is then packed and written in one piece, some
// milliseconds. What was written reads back, whatever becomes of the writer: a file that was not closed ends at its
// last whole block. A block that the disk does not take is lost, and nothing of it is left in the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/file/output_file.hpp"
#include "tools/recording/block.hpp"
#include "tools/recording/recorded_kinds.hpp"
#include "tools/recording/recording_file.hpp"

namespace yars::tools::recording {

using file::Existing;  // a plain file of the name

class RecordingWriter {
 public:
  // The file is the user's alone (0600). An error: it is there already, it is a link, it cannot be written, or the
  // header does not fit. A full disk is none here: it is told by the first append, and resume() goes on.
  static error::Expected<RecordingWriter> create(const std::filesystem::path& path, const RecordingHeader& header,
                                                 Existing existing = Existing::refused);

  // `T`: one of RecordingItem's. An error: the disk took no more; so do all calls after the first, until resume(). What
  // is in the file by then reads back.
  template <class T>
  error::Expected<void> append(const T& record) {
    return append(*recorded_kind(kKindOf<T>.number), parts_of(record), tick_of(record));
  }
  // Writes what has been gathered, so that a reader finds it.
  error::Expected<void> flush();
  // After an error: drops what could not be written and goes on behind what is whole. An error: still no room.
  error::Expected<void> resume();
  // And the index: the recording is then whole.
  error::Expected<void> close();
  // Closes the file, sets it aside as FILE.before in the place of an older one, and begins FILE anew.
  error::Expected<void> begin_next();

  std::uint64_t bytes() const { return bytes_; }  // in the file

 private:
  RecordingWriter(std::shared_ptr<const file::Folder> folder, std::string name, RecordingHeader header)
      : folder_(std::move(folder)), name_(std::move(name)), header_(std::move(header)) {}
  error::Expected<void> append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick);
  error::Expected<void> write(const std::vector<std::byte>& bytes);
  bool write_header();
  tl::unexpected<error::Error> no_room(int problem);

  int descriptor() const { return file_ ? file_->descriptor() : -1; }

  std::shared_ptr<const file::Folder> folder_;
  std::string name_;
  RecordingHeader header_;
  std::optional<file::NewFile> file_;
  BlockBuilder block_;
  Packer packer_;
  std::vector<IndexEntry> blocks_;
  std::uint64_t bytes_ = 0;
  std::optional<error::Error> error_;
};

}  // namespace yars::tools::recording
