#include "lib/file/output_file.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <optional>
#include <utility>

namespace yars::file {

using error::Expected;
using error::fail;

namespace {

constexpr int kAttempts = 100;  // maximum number of names tried; one collision of 64-bit names is already unlikely

// A different number at each call, from process ID and call counter, for a system that refuses getrandom(). Other users
// can guess the number. This is safe, because a file is created only under a name that does not exist.
std::uint64_t number_without_getrandom() {
  static std::atomic<std::uint32_t> calls{0};
  return static_cast<std::uint64_t>(::getpid()) << 32 | calls.fetch_add(1);
}

std::string random_name() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != sizeof number) number = number_without_getrandom();
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), ".yars-%016" PRIx64 ".tmp", number);
  return name.data();
}

// Mode of the file that a symbolic link points to; nullopt if the link is dangling.
std::optional<mode_t> mode_of_link_target(const Folder& folder, const std::string& name) {
  struct stat status{};
  if (::fstatat(folder.descriptor(), name.c_str(), &status, 0) != 0) return std::nullopt;
  return status.st_mode;
}

tl::unexpected<error::Error> wrong_kind_of_file(const std::string& path, const char* found) {
  return fail(path, "a file that can be written", found, "remove it, or name another file");
}

tl::unexpected<error::Error> system_failure(const std::string& path, int problem) {
  return fail(path, "a file that can be written", error::reason_of(problem, "no folder for it"), write_advice(problem));
}

}  // namespace

bool is_missing_space(int error_number) {
  return error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG;
}

const char* write_advice(int error_number) {
  if (error_number == EFBIG) return "raise the limit of a file's size (ulimit -f)";
  if (is_missing_space(error_number)) return "check the space on the disk";
  return error_number == EIO ? "check the disk" : "check the folder and its rights";
}

Expected<NewFile> NewFile::create(const std::filesystem::path& path, Rights rights) {
  auto folder = Folder::open(path.parent_path());
  if (!folder) return tl::unexpected(folder.error());
  return create(std::make_shared<const Folder>(std::move(*folder)), path.filename().string(), rights);
}

Expected<NewFile> NewFile::create(std::shared_ptr<const Folder> folder, const std::string& name, Rights rights,
                                  Existing existing) {
  NewFile file(std::move(folder), name);
  file.existing_ = existing;
  if (name.empty() || name == "." || name == "..") return wrong_kind_of_file(file.shown(), "a folder");
  if (auto allowed = file.check_target(); !allowed) return tl::unexpected(allowed.error());
  auto opened = file.device_ ? file.open_device() : file.open_temporary(rights == Rights::user_alone ? 0600 : 0644);
  if (!opened) return tl::unexpected(opened.error());
  return file;
}

NewFile::NewFile(NewFile&&) noexcept = default;

NewFile& NewFile::operator=(NewFile&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(name_, other.name_);
  std::swap(temporary_name_, other.temporary_name_);
  std::swap(stream_, other.stream_);
  std::swap(existing_, other.existing_);
  std::swap(write_problem_, other.write_problem_);
  std::swap(placed_, other.placed_);
  std::swap(device_, other.device_);
  return *this;
}

NewFile::~NewFile() {
  if (stream_ && !placed_ && !temporary_name_.empty()) ::unlinkat(folder_->descriptor(), temporary_name_.c_str(), 0);
}

// Rejects targets that a rename must not replace: folders, pipes, sockets, block devices, and symbolic links to one of
// these or to a character device. With Existing::refused, regular files and all links are rejected too.
// Without this check a process of root could replace a device.
Expected<void> NewFile::check_target() {
  const auto entry = folder_->status_of(name_);
  if (!entry) {
    if (errno == ENOENT) return {};
    return system_failure(shown(), errno);
  }
  device_ = S_ISCHR(entry->st_mode);
  if (!device_ && existing_ == Existing::refused) return wrong_kind_of_file(shown(), name_of_kind(entry->st_mode));
  if (S_ISREG(entry->st_mode) || device_) return {};
  if (!S_ISLNK(entry->st_mode)) return wrong_kind_of_file(shown(), name_of_kind(entry->st_mode));
  const auto target_mode = mode_of_link_target(*folder_, name_);
  if (!target_mode || S_ISREG(*target_mode)) return {};
  return wrong_kind_of_file(shown(), (std::string("a link to ") + name_of_kind(*target_mode)).c_str());
}

Expected<void> NewFile::open_device() {
  Descriptor descriptor(
      ::openat(folder_->descriptor(), name_.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!descriptor) return system_failure(shown(), errno);
  if (auto opened = open_stream(std::move(descriptor)); !opened) return opened;
  placed_ = true;
  return {};
}

Expected<void> NewFile::open_temporary(mode_t mode) {
  Descriptor descriptor(::openat(folder_->descriptor(), ".", O_TMPFILE | O_RDWR | O_CLOEXEC, mode));
  // Not every file system supports O_TMPFILE.
  if (!descriptor && (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL || errno == ENOENT)) {
    for (int attempt = 0; !descriptor && attempt < kAttempts; ++attempt) {
      temporary_name_ = random_name();
      descriptor = Descriptor(::openat(folder_->descriptor(), temporary_name_.c_str(),
                                       O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
      if (!descriptor && errno != EEXIST) break;
    }
  }
  if (!descriptor) return system_failure(shown(), errno);
  return open_stream(std::move(descriptor));
}

Expected<void> NewFile::open_stream(Descriptor descriptor) {
  stream_.reset(::fdopen(descriptor.number(), "wb"));
  if (stream_) {
    descriptor.release();
    return {};
  }
  const int problem = errno;
  if (!temporary_name_.empty()) folder_->remove(temporary_name_);
  return system_failure(shown(), problem);
}

Expected<void> NewFile::link_temporary_name() {
  const std::string descriptor_path = "/proc/self/fd/" + std::to_string(::fileno(stream_.get()));
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::string name = random_name();
    if (::linkat(AT_FDCWD, descriptor_path.c_str(), folder_->descriptor(), name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      temporary_name_ = name;
      return {};
    }
    if (errno != EEXIST) break;
  }
  return system_failure(shown(), errno);
}

void NewFile::write(std::span<const std::byte> bytes) {
  if (bytes.empty() || write_problem_ != 0) return;
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) < bytes.size())
    write_problem_ = errno != 0 ? errno : EIO;
}

void NewFile::write(std::string_view text) {
  write(std::as_bytes(std::span(text)));
}

Expected<void> NewFile::flush() {
  errno = 0;
  if (write_problem_ == 0 && std::fflush(stream_.get()) != 0) write_problem_ = errno != 0 ? errno : EIO;
  if (write_problem_ == 0) return {};
  return system_failure(shown(), write_problem_);
}

Expected<void> NewFile::place() {
  if (auto flushed = flush(); !flushed || placed_) return flushed;
  if (temporary_name_.empty())
    if (auto named = link_temporary_name(); !named) return named;
  // The target may have changed since create().
  if (auto allowed = check_target(); !allowed) return allowed;
  if (device_) return wrong_kind_of_file(shown(), "a device");
  if (auto moved = rename_to_target(); !moved) return moved;
  placed_ = true;
  return {};
}

Expected<void> NewFile::rename_to_target() {
  const int folder = folder_->descriptor();
  if (existing_ == Existing::overwritten) {
    if (folder_->rename_file(temporary_name_, name_)) return {};
    return system_failure(shown(), errno);
  }
  if (::renameat2(folder, temporary_name_.c_str(), folder, name_.c_str(), RENAME_NOREPLACE) == 0) return {};
  // Not every file system supports RENAME_NOREPLACE. A hard link does not replace an existing file either.
  if (errno == EINVAL && ::linkat(folder, temporary_name_.c_str(), folder, name_.c_str(), 0) == 0) {
    folder_->remove(temporary_name_);
    return {};
  }
  return system_failure(shown(), errno);
}

int NewFile::descriptor() const {
  return stream_ ? ::fileno(stream_.get()) : -1;
}

Expected<void> NewFile::finish() {
  if (auto done = place(); !done) return done;
  errno = 0;
  if (std::fclose(stream_.release()) == 0) return {};
  return system_failure(shown(), errno != 0 ? errno : EIO);
}

Expected<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes, Rights rights) {
  auto file = NewFile::create(path, rights);
  if (!file) return tl::unexpected(file.error());
  file->write(bytes);
  return file->finish();
}

Expected<void> write_file(const std::filesystem::path& path, std::string_view text, Rights rights) {
  return write_file(path, std::as_bytes(std::span(text)), rights);
}

Expected<std::filesystem::path> write_file_and_folders(const std::filesystem::path& path,
                                                       std::span<const std::byte> bytes) {
  if (auto folder = Folder::make(path.parent_path()); !folder) return tl::unexpected(folder.error());
  if (auto written = write_file(path, bytes); !written) return tl::unexpected(written.error());
  return path;
}

namespace {

constexpr const char* kAdvice = "remove it, or name another folder";

// Description of a file that must not be used as a log, for the error message; nullopt if it may be used.
// A file with a second hard link is refused, because its other name may be outside the log folder.
std::optional<std::string> unsuitable_log(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return name_of_kind(status.st_mode);
  if (status.st_uid != ::geteuid()) return "a file of user " + std::to_string(status.st_uid);
  if (status.st_nlink != 1) return "a file with " + std::to_string(status.st_nlink) + " names";
  return std::nullopt;
}

}  // namespace

Expected<LogFile> LogFile::open(Folder folder, std::string name, Limits limits) {
  LogFile file(std::move(folder), std::move(name), limits);
  if (auto opened = file.open_newest(); !opened) return tl::unexpected(opened.error());
  return file;
}

std::string LogFile::name_of(std::size_t age) const {
  return age == 0 ? name_ + ".log" : name_ + "." + std::to_string(age) + ".log";
}

Expected<void> LogFile::open_newest() {
  const std::string name = name_of(0);
  const std::string shown = (folder_.path() / name).string();
  // Checked before open(): opening a device or a pipe can have side effects.
  const auto entry = folder_.status_of(name);
  if (entry)
    if (const auto found = unsuitable_log(*entry)) return fail(shown, "a log file of this user", *found, kAdvice);
  newest_ = Descriptor(::openat(folder_.descriptor(), name.c_str(),
                                O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0600));
  struct stat status{};
  if (!newest_ || ::fstat(newest_.number(), &status) != 0)
    return fail(shown, "a log file that can be written", error::reason_of(errno, "no folder for it"),
                "check the folder and its rights");
  if (const auto found = unsuitable_log(status)) return fail(shown, "a log file of this user", *found, kAdvice);
  ::fchmod(newest_.number(), 0600);
  bytes_ = static_cast<std::size_t>(status.st_size);
  return {};
}

Expected<void> LogFile::rotate() {
  for (std::size_t age = limits_.old; age > 0; --age) folder_.rename_file(name_of(age - 1), name_of(age));
  // NAME.log is deleted if it was not renamed. It would otherwise grow beyond limits_.bytes.
  folder_.remove(name_of(0));
  return open_newest();
}

Expected<void> LogFile::return_to_path() {
  if (folder_.has_at_path(name_of(0), newest_.number())) return {};
  auto reopened = Folder::make_private(folder_.path());
  if (!reopened) return tl::unexpected(reopened.error());
  folder_ = std::move(*reopened);
  return open_newest();
}

Expected<void> LogFile::append(std::string_view text) {
  if (auto returned = return_to_path(); !returned) return returned;
  if (bytes_ > 0 && bytes_ + text.size() > limits_.bytes)
    if (auto rotated = rotate(); !rotated) return rotated;
  while (!text.empty()) {
    const ssize_t count = ::write(newest_.number(), text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int problem = count == 0 ? ENOSPC : errno;
      return fail((folder_.path() / name_of(0)).string(), "a log file that can be written",
                  error::reason_of(problem, "no folder for it"), write_advice(problem));
    }
    bytes_ += static_cast<std::size_t>(count);
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

void occupy_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
}

}  // namespace yars::file
