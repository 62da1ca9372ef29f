#include "tools/recording/recording_writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace yars::tools::recording {

namespace {

// The user's alone, an older file of that name too; no link is followed. -1 with errno set.
int open_private(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
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

}  // namespace

failure::Expected<RecordingWriter> RecordingWriter::create(const std::filesystem::path& path,
                                                           const RecordingHeader& header) {
  if (header.configuration.size() > kMostHeaderText || header.terrain.size() > kMostHeaderText)
    return failure::fail(path.string(), "paths of at most " + std::to_string(kMostHeaderText) + " bytes to record",
                         "a longer one of the configuration or the terrain", "give it a shorter path");
  RecordingWriter writer;
  writer.path_ = path;
  // Through the descriptor, so that it is this very file that is written, whatever its name leads to by then.
  const int descriptor = open_private(path);
  if (descriptor >= 0) writer.file_.open("/proc/self/fd/" + std::to_string(descriptor), std::ios::binary);
  const int problem = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!writer.file_.is_open())
    return failure::fail(path.string(), "a file that can be written", std::strerror(problem),
                         problem == ELOOP ? "it is a link: name the file that it leads to, or remove it"
                                          : "check the folder and its rights");
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
  auto written = write(bytes_of(blocks_, bytes_, packer_));
  file_.close();
  return written;
}

failure::Expected<void> RecordingWriter::write(const std::vector<std::byte>& bytes) {
  errno = 0;
  file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (file_.flush()) {
    bytes_ += bytes.size();
    return {};
  }
  error_ = failure::Error{path_.string(), "room on the disk", errno != 0 ? std::strerror(errno) : "a write that failed",
                          "the recording ends at its last whole second", false};
  return tl::unexpected(*error_);
}

}  // namespace yars::tools::recording
