#include "tools/recording/recording_writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace yars::tools::recording {

namespace {

bool is_device(const std::filesystem::path& path) {
  std::error_code problem;
  return std::filesystem::symlink_status(path, problem).type() == std::filesystem::file_type::character;
}

// The user's alone, an older file of that name too; no link is followed. -1 with errno set.
int open_private(const std::filesystem::path& path, Existing existing) {
  const int there = existing == Existing::overwritten || is_device(path) ? O_TRUNC : O_EXCL;
  std::error_code problem_of_link;
  if (std::filesystem::is_symlink(path, problem_of_link)) {
    errno = ELOOP;
    return -1;
  }
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | there | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
  if (descriptor < 0) return -1;
  struct stat status {};
  const bool ready = fstat(descriptor, &status) == 0 &&
                     (!S_ISREG(status.st_mode) || fchmod(descriptor, 0600) == 0);  // a device keeps its rights
  if (ready) return descriptor;
  const int problem = errno;
  ::close(descriptor);
  errno = problem;
  return -1;
}

const char* what_to_do(int problem) {
  if (problem == ELOOP) return "it is a link: name the file that it leads to, or remove it";
  if (problem == EEXIST) return "name another file, or write over it with --overwrite";
  return "check the folder and its rights";
}

constexpr off_t kRoomToGoOn = 1 << 20;  // [bytes] with less the next blocks would be lost again

// 0, or why there is no room for the blocks to come. A device takes what it takes.
int look_for_room(int descriptor, std::uint64_t at) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  const int problem = posix_fallocate(descriptor, static_cast<off_t>(at), kRoomToGoOn);
  const bool as_before = ftruncate(descriptor, static_cast<off_t>(at)) == 0;
  return problem != 0 ? problem : as_before ? 0 : errno;
}

// All of it, or none: what was written of it is taken back. 0, or why not.
int append_whole(int descriptor, std::uint64_t at, const std::vector<std::byte>& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count > 0) {
      done += static_cast<std::size_t>(count);
      continue;
    }
    const int problem = count == 0 ? ENOSPC : errno;
    // A device has no length; there is nothing to take back.
    if (ftruncate(descriptor, static_cast<off_t>(at)) == 0) lseek(descriptor, static_cast<off_t>(at), SEEK_SET);
    return problem;
  }
  return 0;
}

}  // namespace

RecordingWriter::Descriptor::~Descriptor() {
  if (number >= 0) ::close(number);
}

failure::Expected<RecordingWriter> RecordingWriter::create(const std::filesystem::path& path,
                                                           const RecordingHeader& header, Existing existing) {
  if (header.configuration.size() > kMostHeaderText || header.terrain.size() > kMostHeaderText)
    return failure::fail(path.string(), "paths of at most " + std::to_string(kMostHeaderText) + " bytes to record",
                         "a longer one of the configuration or the terrain", "give it a shorter path");
  RecordingWriter writer;
  writer.path_ = path;
  writer.header_ = header;
  writer.file_ = Descriptor(open_private(path, existing));
  if (const int problem = errno; writer.file_.number < 0)
    return failure::fail(path.string(), problem == EEXIST ? "a new file to record into" : "a file that can be written",
                         problem == EEXIST ? "one that is there already" : std::strerror(problem), what_to_do(problem));
  writer.write_header();
  return writer;
}

// False, and an error for the calls to come: there is no room for it.
bool RecordingWriter::write_header() {
  const auto bytes = bytes_of(header_);
  if (const int problem = append_whole(file_.number, 0, bytes); problem != 0) {
    no_room(problem);
    return false;
  }
  bytes_ = bytes.size();
  return true;
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
  const IndexEntry entry{bytes_, block_.first_tick(), block_.last_tick(), block_.kinds()};
  auto written = write(block_.take(packer_));
  if (written) blocks_.push_back(entry);
  return written;
}

failure::Expected<void> RecordingWriter::resume() {
  if (!error_) return {};
  if (const int problem = look_for_room(file_.number, bytes_); problem != 0) return no_room(problem);
  block_.take(packer_);
  error_.reset();
  if (bytes_ == 0 && !write_header()) return tl::unexpected(*error_);
  return {};
}

failure::Expected<void> RecordingWriter::close() {
  if (auto written = flush(); !written) return written;
  auto written = write(bytes_of(blocks_, bytes_, packer_));
  file_ = Descriptor();
  return written;
}

failure::Expected<void> RecordingWriter::begin_next() {
  if (auto closed = close(); !closed) return closed;
  std::error_code problem;
  std::filesystem::path before = path_;
  before += ".before";
  std::filesystem::rename(path_, before, problem);
  file_ = Descriptor(problem ? -1 : open_private(path_, Existing::refused));
  if (file_.number < 0) return no_room(problem ? problem.value() : errno);
  blocks_.clear();
  bytes_ = 0;
  if (!write_header()) return tl::unexpected(*error_);
  return {};
}

failure::Expected<void> RecordingWriter::write(const std::vector<std::byte>& bytes) {
  if (const int problem = append_whole(file_.number, bytes_, bytes); problem != 0) return no_room(problem);
  bytes_ += bytes.size();
  return {};
}

tl::unexpected<failure::Error> RecordingWriter::no_room(int problem) {
  error_ = failure::Error{path_.string(), "room on the disk", std::strerror(problem),
                          "what is in the file by then can be read", false};
  return tl::unexpected(*error_);
}

}  // namespace yars::tools::recording
