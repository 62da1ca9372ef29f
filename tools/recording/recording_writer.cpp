#include "tools/recording/recording_writer.hpp"

#include <memory>
#include <string>
#include <utility>

#include "lib/file/folder.hpp"

namespace yars::tools::recording {

namespace {

// Whoever made a link to a large disk does not want the recording beside the link.
failure::Expected<file::NewFile> create_file(const std::filesystem::path& path) {
  auto folder = file::Folder::open(path.parent_path());
  if (!folder) return tl::unexpected(folder.error());
  const std::string name = path.filename().string();
  if (const auto there = folder->look(name); there && S_ISLNK(there->st_mode))
    return failure::fail(path.string(), "a file that can be written", "a link",
                         "it is a link: name the file that it leads to, or remove it");
  return file::NewFile::create(std::make_shared<const file::Folder>(std::move(*folder)), name,
                               file::Rights::user_alone);
}

}  // namespace

failure::Expected<RecordingWriter> RecordingWriter::create(const std::filesystem::path& path,
                                                           const RecordingHeader& header) {
  if (header.configuration.size() > kMostHeaderText || header.terrain.size() > kMostHeaderText)
    return failure::fail(path.string(), "paths of at most " + std::to_string(kMostHeaderText) + " bytes to record",
                         "a longer one of the configuration or the terrain", "give it a shorter path");
  auto file = create_file(path);
  if (!file) return tl::unexpected(file.error());
  // A reader may follow it from the first second on.
  if (auto placed = file->place(); !placed) return tl::unexpected(placed.error());
  RecordingWriter writer(path, std::move(*file));
  if (auto written = writer.write(bytes_of(header)); !written) return tl::unexpected(written.error());
  return writer;
}

failure::Expected<void> RecordingWriter::append(const RecordedKind& kind, const RecordParts& parts,
                                                std::optional<std::int64_t> tick) {
  if (block_.is_full_for(parts, tick))
    if (auto written = flush(); !written) return written;
  if (error_) return tl::unexpected(*error_);
  block_.append(kind, parts, tick);
  return {};
}

failure::Expected<void> RecordingWriter::flush() {
  if (error_) return tl::unexpected(*error_);
  if (block_.empty()) return {};
  blocks_.push_back({bytes_, block_.first_tick(), block_.last_tick(), block_.kinds()});
  return write(block_.take(packer_));
}

failure::Expected<void> RecordingWriter::close() {
  if (auto written = flush(); !written) return written;
  if (auto written = write(bytes_of(blocks_, bytes_, packer_)); !written) return written;
  return file_.finish();
}

failure::Expected<void> RecordingWriter::write(const std::vector<std::byte>& bytes) {
  file_.write(bytes);
  const auto flushed = file_.flush();
  if (flushed) {
    bytes_ += bytes.size();
    return {};
  }
  error_ = failure::Error{path_.string(), "room on the disk", flushed.error().found,
                          "the recording ends at its last whole second", false};
  return tl::unexpected(*error_);
}

}  // namespace yars::tools::recording
