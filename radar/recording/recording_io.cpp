#include "radar/recording/recording_io.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <utility>

#include "radar/recording/block.hpp"

namespace yars::recording {

error::Expected<RecordingReader> RecordingReader::open(const std::filesystem::path& path) {
  std::error_code code;
  // Opening a pipe could block forever, and a reader cannot seek in a pipe.
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    return error::fail(path.string(), "a recording in a regular file", "a folder, a pipe, a socket or a device",
                       "copy the recording into a regular file");
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file)
    return error::fail(path.string(), "a recording that can be read", error::reason_of(errno), "check the path");
  return read(std::move(file), path.string());
}

error::Expected<RecordingReader> RecordingReader::read(std::unique_ptr<std::istream> file, const std::string& name) {
  RecordingReader reader;
  auto header = read_header(*file, name);
  if (!header) return tl::unexpected(header.error());
  reader.header_ = std::move(*header);
  reader.index_ = read_index(*file, static_cast<std::uint64_t>(file->tellg()));
  reader.file_ = std::move(file);
  return reader;
}

std::vector<std::byte> RecordingReader::bytes_at(std::uint64_t offset) {
  BlockHead head{};
  file_->clear();
  file_->seekg(static_cast<std::streamoff>(offset));
  if (!file_->read(reinterpret_cast<char*>(&head), sizeof head) || !is_sound(head) ||
      head.content != BlockContent::items)
    return {};
  std::vector<std::byte> bytes(sizeof head + head.body_bytes);
  std::memcpy(bytes.data(), &head, sizeof head);
  const std::span body = std::span(bytes).subspan(sizeof head);
  if (!file_->read(reinterpret_cast<char*>(body.data()), static_cast<std::streamsize>(body.size()))) return {};
  if (!body_matches(head, body)) return {};
  return bytes;
}

std::optional<BlockItems> RecordingReader::block_at(std::uint64_t offset) {
  const auto bytes = bytes_at(offset);
  if (bytes.empty()) return std::nullopt;
  BlockHead head{};
  std::memcpy(&head, bytes.data(), sizeof head);
  return BlockItems::decode(head, std::span(bytes).subspan(sizeof head));
}

std::vector<std::byte> RecordingReader::bytes_of_block(std::size_t block) {
  return block < index_.blocks.size() ? bytes_at(index_.blocks[block].offset) : std::vector<std::byte>();
}

std::optional<BlockItems> RecordingReader::undamaged_block(std::size_t block) {
  const IndexEntry& entry = index_.blocks[block];
  if (auto items = block_at(entry.offset)) return items;
  const auto at = std::ranges::lower_bound(missing_, entry.offset, {}, &IndexEntry::offset);
  if (at == missing_.end() || at->offset != entry.offset) missing_.insert(at, entry);
  return std::nullopt;
}

std::optional<RecordingItem> RecordingReader::next() {
  for (;;) {
    if (block_)
      if (auto item = block_->next()) return item;
    block_.reset();
    if (next_block_ >= index_.blocks.size()) return std::nullopt;
    block_ = undamaged_block(next_block_++);
    hole_ = hole_ || !block_;
  }
}

std::size_t RecordingReader::block_of(std::int64_t tick) const {
  const auto& blocks = index_.blocks;
  auto found = std::find_if(blocks.begin(), blocks.end(),
                            [tick](const auto& block) { return block.first_tick <= tick && tick <= block.last_tick; });
  if (found == blocks.end()) {
    const auto before =
        std::find_if(blocks.rbegin(), blocks.rend(), [tick](const auto& block) { return block.first_tick <= tick; });
    found = before == blocks.rend() ? blocks.begin() : before.base() - 1;
  }
  return static_cast<std::size_t>(found - blocks.begin());
}

void RecordingReader::seek_block(std::size_t block) {
  next_block_ = std::min(block, index_.blocks.size());
  block_.reset();
  hole_ = false;
}

std::optional<BlockItems> RecordingReader::items_of(std::size_t block) {
  if (block >= index_.blocks.size()) return std::nullopt;
  return undamaged_block(block);
}

std::optional<RecordingItem> RecordingReader::last_before(std::uint8_t kind) {
  const std::size_t end = next_block_ - (block_ ? 1 : 0);
  for (std::size_t i = end; i-- > 0;) {
    if ((index_.blocks[i].kinds >> kind & 1U) == 0) continue;
    const auto block = undamaged_block(i);
    if (!block) continue;
    if (auto item = block->last_of(kind)) return item;
  }
  return std::nullopt;
}

namespace {

// A symbolic link is an error, because the new file would replace the link instead of its target.
error::Expected<file::NewFile> create_file(const std::shared_ptr<const file::Folder>& folder, const std::string& name,
                                           file::Existing existing) {
  const auto status = folder->status_of(name);
  const std::string path = (folder->path() / name).string();
  if (status && S_ISLNK(status->st_mode))
    return error::fail(path, "a file that can be written", "a symbolic link",
                       "name the file that the link leads to, or remove the link");
  if (status && S_ISREG(status->st_mode) && existing == file::Existing::refused)
    return error::fail(path, "a new file to record into", "an existing file",
                       "name another file, or write over it with --overwrite");
  auto created = file::NewFile::create(folder, name, file::Rights::user_alone, existing);
  // Gives the file its name at once, so that a reader can open it during the recording.
  if (created)
    if (auto placed = created->place(); !placed) return tl::unexpected(placed.error());
  return created;
}

// Lock of the whole file that its writer holds until it closes the file.
struct flock writer_lock() {
  struct flock lock{};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

constexpr off_t kMinFree_bytes = 1 << 20;  // free space required to resume, so that the next blocks are not lost

// Checks for kMinFree_bytes of free space after offset `at`, which must be the end of the file. Returns 0, or the errno
// of the failure. Always returns 0 for a device.
int check_free_space(int descriptor, std::uint64_t at) {
  struct stat status{};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const int problem = posix_fallocate(descriptor, static_cast<off_t>(at), kMinFree_bytes);
  const bool restored = ftruncate(descriptor, static_cast<off_t>(at)) == 0;
  return problem != 0 ? problem : restored ? 0 : errno;
}

// Appends all bytes at the file position, which must be `at`. After a failure truncates the file to `at`. Returns 0, or
// the errno of the failure.
int append_whole(int descriptor, std::uint64_t at, const std::vector<std::byte>& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count > 0) {
      done += static_cast<std::size_t>(count);
      continue;
    }
    const int problem = count == 0 ? ENOSPC : errno;
    // On a device ftruncate fails, and the bytes already written remain.
    if (ftruncate(descriptor, static_cast<off_t>(at)) == 0) lseek(descriptor, static_cast<off_t>(at), SEEK_SET);
    return problem;
  }
  return 0;
}

}  // namespace

bool is_being_written(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct flock lock = writer_lock();
  const bool is_known = fcntl(descriptor, F_OFD_GETLK, &lock) == 0;
  ::close(descriptor);
  return is_known && lock.l_type != F_UNLCK;
}

error::Expected<RecordingWriter> RecordingWriter::create(const std::filesystem::path& path,
                                                         const RecordingHeader& header, Existing existing) {
  if (header.configuration.size() > kMaxHeaderText || header.terrain.size() > kMaxHeaderText)
    return error::fail(path.string(), "paths of at most " + std::to_string(kMaxHeaderText) + " bytes to record",
                       "a longer path of the configuration or the terrain", "give it a shorter path");
  auto folder = file::Folder::open(path.parent_path());
  if (!folder) return tl::unexpected(folder.error());
  RecordingWriter writer(std::make_shared<const file::Folder>(std::move(*folder)), path.filename().string(), header);
  if (auto begun = writer.begin_file(existing); !begun) return tl::unexpected(begun.error());
  writer.write_header();
  return writer;
}

// Creates the file at the path, without its header.
error::Expected<void> RecordingWriter::begin_file(Existing existing) {
  if (!folder_->is_at_path()) {
    auto folder = file::Folder::open(folder_->path());
    if (!folder) return tl::unexpected(*(error_ = folder.error()));
    folder_ = std::make_shared<const file::Folder>(std::move(*folder));
  }
  auto file = create_file(folder_, name_, existing);
  if (!file) return tl::unexpected(*(error_ = file.error()));
  file_ = std::move(*file);
  // Without the lock the file is written all the same; `yars recordings` then does not report that it is.
  struct flock lock = writer_lock();
  fcntl(descriptor(), F_OFD_SETLK, &lock);
  blocks_.clear();
  bytes_ = 0;
  ++files_;
  return {};
}

bool RecordingWriter::is_at_path() const {
  return file_ && folder_->has_at_path(name_, descriptor());
}

error::Expected<void> RecordingWriter::check_place() {
  if (error_) return tl::unexpected(*error_);
  if (is_at_path()) return {};
  error_ = error::Error{(folder_->path() / name_).string(), "the recording under its name",
                        "that it was removed or renamed", "leave it in place until the recorder has ended"};
  return tl::unexpected(*error_);
}

// Returns false and sets error_ when the header cannot be written.
bool RecordingWriter::write_header() {
  const auto bytes = bytes_of(header_);
  if (const int problem = append_whole(descriptor(), 0, bytes); problem != 0) {
    write_failed(problem);
    return false;
  }
  bytes_ = bytes.size();
  return true;
}

error::Expected<void> RecordingWriter::append(const RecordedKind& kind, const RecordParts& parts,
                                              std::optional<std::int64_t> tick) {
  if (block_.is_full_for(parts, tick))
    if (auto written = flush(); !written) return written;
  if (error_) return tl::unexpected(*error_);
  block_.append(kind, parts, tick);
  return {};
}

error::Expected<void> RecordingWriter::flush() {
  if (error_) return tl::unexpected(*error_);
  if (block_.empty()) return {};
  const IndexEntry entry{bytes_, block_.first_tick(), block_.last_tick(), block_.kinds()};
  auto written = write(block_.take(compressor_));
  if (written) blocks_.push_back(entry);
  return written;
}

error::Expected<void> RecordingWriter::append_block(const std::vector<std::byte>& block, const IndexEntry& entry) {
  if (auto written = flush(); !written) return written;
  const IndexEntry here{bytes_, entry.first_tick, entry.last_tick, entry.kinds};
  auto written = write(block);
  if (written) blocks_.push_back(here);
  return written;
}

error::Expected<void> RecordingWriter::resume() {
  if (!error_) return {};
  if (set_aside_due_)
    if (auto moved = set_aside(); !moved) return moved;
  if (!is_at_path())
    if (auto begun = begin_file(Existing::refused); !begun) return begun;
  if (const int problem = check_free_space(descriptor(), bytes_); problem != 0) return write_failed(problem);
  block_.take(compressor_);
  error_.reset();
  if (bytes_ == 0 && !write_header()) return tl::unexpected(*error_);
  return {};
}

error::Expected<void> RecordingWriter::close() {
  if (auto written = flush(); !written) return written;
  if (auto placed = check_place(); !placed) return placed;
  auto written = write(bytes_of(blocks_, bytes_, compressor_));
  if (written) file_.reset();  // after an error, resume() may still continue the file
  return written;
}

error::Expected<void> RecordingWriter::begin_next() {
  if (auto closed = close(); !closed) return closed;
  set_aside_due_ = true;
  if (auto moved = set_aside(); !moved) return moved;
  if (auto begun = begin_file(Existing::refused); !begun) return begun;
  if (!write_header()) return tl::unexpected(*error_);
  return {};
}

// Renames the closed file to FILE.before. A file that was removed meanwhile needs no other name.
error::Expected<void> RecordingWriter::set_aside() {
  if (!folder_->rename_file(name_, name_ + ".before") && errno != ENOENT) {
    error_ = error::Error{(folder_->path() / (name_ + ".before")).string(), "a name for the recording that is full",
                          std::strerror(errno), "remove what is there"};
    return tl::unexpected(*error_);
  }
  set_aside_due_ = false;
  return {};
}

error::Expected<void> RecordingWriter::write(const std::vector<std::byte>& bytes) {
  if (const int problem = append_whole(descriptor(), bytes_, bytes); problem != 0) return write_failed(problem);
  bytes_ += bytes.size();
  return {};
}

tl::unexpected<error::Error> RecordingWriter::write_failed(int error_number) {
  const bool space = file::is_missing_space(error_number);
  error_ = error::Error{(folder_->path() / name_).string(),
                        space ? "free space on the disk" : "a recording that can be written",
                        error::reason_of(error_number, "no folder for it"),
                        (space ? "" : std::string(file::write_advice(error_number)) + "; ") +
                            std::string("the blocks already in the file can be read")};
  return tl::unexpected(*error_);
}

}  // namespace yars::recording
