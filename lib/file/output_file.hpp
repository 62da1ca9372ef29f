// Writers of all files of YARS: new files, which appear under their name when they are complete, and logs.
// Inputs: a folder and a name, or a path; bytes or text.
// Outputs: a complete file. A process that dies meanwhile leaves the previous file unchanged.
// Errors: an Error for the folder (folder.hpp), for a target that is no plain file, or for a failed write.
// Security: existing files are replaced, never written through. Source: docs/security.md.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "lib/error/error.hpp"
#include "lib/file/folder.hpp"

namespace yars::file {

// Treatment of a file that exists at the target path. A character device is written to in both cases.
enum class Existing { overwritten, refused };

// File that is written without a name (O_TMPFILE) or under a random name, and renamed to its target when complete.
// place() replaces a plain file, or a link to one or to nothing; of a link, the link itself is replaced.
// A pipe, a socket, a folder or a link to any other kind of file is an error. A device is written to directly.
// After an error the target is unchanged.
class NewFile {
 public:
  static error::Expected<NewFile> create(const std::filesystem::path& path, Rights rights = Rights::by_umask);
  static error::Expected<NewFile> create(std::shared_ptr<const Folder> folder, const std::string& name,
                                         Rights rights = Rights::by_umask, Existing existing = Existing::overwritten);
  NewFile(NewFile&&) noexcept;
  NewFile& operator=(NewFile&&) noexcept;
  ~NewFile();  // removes a file that has not been placed

  std::string shown() const { return (folder_->path() / name_).string(); }  // target path, for messages
  // For libraries that write to a stream. flush(), place() and finish() report their errors.
  std::FILE* stream() { return stream_.get(); }
  int descriptor() const;  // -1 after finish()
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  // Flushes and renames the file to its target. Writing can go on, as it does in a recording.
  error::Expected<void> place();
  // Hands buffered bytes to the operating system. An error: this write or an earlier one has failed.
  error::Expected<void> flush();
  // place(), then closes the file.
  error::Expected<void> finish();

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  NewFile(std::shared_ptr<const Folder> folder, std::string name)
      : folder_(std::move(folder)), name_(std::move(name)) {}
  error::Expected<void> check_target();
  error::Expected<void> rename_to_target();
  error::Expected<void> open_temporary(mode_t mode);
  error::Expected<void> open_device();
  error::Expected<void> link_temporary_name();

  std::shared_ptr<const Folder> folder_;
  std::string name_;
  std::string temporary_name_;  // empty: the file has no name
  std::unique_ptr<std::FILE, Close> stream_;
  Existing existing_ = Existing::overwritten;
  bool placed_ = false;
  bool device_ = false;
};

// Writes a whole file.
error::Expected<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                                 Rights rights = Rights::by_umask);
error::Expected<void> write_file(const std::filesystem::path& path, std::string_view text,
                                 Rights rights = Rights::by_umask);
// As write_file(), and makes the missing folders of the path. Returns `path`.
error::Expected<std::filesystem::path> write_file_and_folders(const std::filesystem::path& path,
                                                              std::span<const std::byte> bytes);

// Log file with rotation: NAME.log is appended to; NAME.1.log is the newest of the old files. Mode 0600.
// A text that does not fit into NAME.log starts a new file; the oldest file is overwritten.
// Errors: NAME.log is no plain file of this user, or has a second hard link; a write has failed.
class LogFile {
 public:
  struct Limits {
    std::size_t bytes = 0;  // [bytes] size of one file
    std::size_t old = 0;    // number of old files kept
  };
  // `name` is without `.log`.
  static error::Expected<LogFile> open(Folder folder, std::string name, Limits limits);

  error::Expected<void> append(std::string_view text);

 private:
  LogFile(Folder folder, std::string name, Limits limits)
      : folder_(std::move(folder)), name_(std::move(name)), limits_(limits) {}
  std::string name_of(std::size_t age) const;
  error::Expected<void> open_newest();
  error::Expected<void> rotate();

  Folder folder_;
  std::string name_;
  Limits limits_;
  Descriptor newest_;
  std::size_t bytes_ = 0;
};

}  // namespace yars::file
