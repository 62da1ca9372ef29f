// Writers of files: a file that replaces its target atomically (NewFile), and a rotated log (LogFile). YARS creates all
// files except the shared segments (shm/) with these classes.
// Inputs: a folder and a name, or a path; bytes or text.
// Outputs: NewFile gives a complete file; if the process dies before place(), the previous file is unchanged. LogFile
// appends each text without buffering.
// Errors: the folder cannot be opened (folder.hpp), the target must not be replaced, or a write fails.
// Security: the only existing file that NewFile writes to is a character device. It never writes through a symbolic
// link at the target path.
// Source: docs/security.md.
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

// True if the error code of a write means lack of space: ENOSPC, EDQUOT, EFBIG.
bool is_missing_space(int error_number);
// Advice for the message about a failed write: check the space, the disk, or the folder.
const char* write_advice(int error_number);

// Treatment of an existing file at the target path. A character device is written to in either case.
enum class Existing { overwritten, refused };

// New file that atomically replaces a target path. The bytes are written to an unnamed file (O_TMPFILE) or to a file
// with a random name. place() renames this file to the target path.
// The target may be missing, a regular file, a symbolic link to a regular file, or a dangling link. place() replaces
// a link, not the file that the link points to. A character device is written to directly.
// Any other target is an error, for example a pipe, a socket or a folder. An error before the rename leaves the target
// unchanged.
class NewFile {
 public:
  static error::Expected<NewFile> create(const std::filesystem::path& path, Rights rights = Rights::by_umask);
  static error::Expected<NewFile> create(std::shared_ptr<const Folder> folder, const std::string& name,
                                         Rights rights = Rights::by_umask, Existing existing = Existing::overwritten);
  NewFile(NewFile&&) noexcept;
  NewFile& operator=(NewFile&&) noexcept;
  ~NewFile();  // discards a file that has not been placed

  std::string shown() const { return (folder_->path() / name_).string(); }  // target path, for messages
  int descriptor() const;                                                   // -1 after finish()
  // After a failed write, further writes have no effect, and flush(), place() and finish() report the failure.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  // Flushes the file and renames it to its target. Later writes continue the renamed file, as recordings need.
  error::Expected<void> place();
  // Passes buffered bytes to the operating system. Error: this write or an earlier write has failed.
  error::Expected<void> flush();
  // Calls place() and closes the file.
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
  error::Expected<void> open_stream(Descriptor descriptor);
  error::Expected<void> link_temporary_name();

  std::shared_ptr<const Folder> folder_;
  std::string name_;
  std::string temporary_name_;  // empty: the file is still unnamed
  std::unique_ptr<std::FILE, Close> stream_;
  Existing existing_ = Existing::overwritten;
  int write_problem_ = 0;  // errno of the first failed write; 0: none has failed
  bool placed_ = false;
  bool device_ = false;
};

// Writes a whole file.
error::Expected<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                                 Rights rights = Rights::by_umask);
error::Expected<void> write_file(const std::filesystem::path& path, std::string_view text,
                                 Rights rights = Rights::by_umask);
// Like write_file(), but also creates the missing folders of the path. Returns `path`.
error::Expected<std::filesystem::path> write_file_and_folders(const std::filesystem::path& path,
                                                              std::span<const std::byte> bytes);

// Log file with rotation, mode 0600. Texts are appended to NAME.log; NAME.1.log is the newest of the old files.
// If a text does not fit into NAME.log, each file is renamed to the next number and the oldest file is deleted. A text
// longer than Limits::bytes is written as a whole to an empty file. A log or folder that was removed or renamed is
// begun again at its path. Errors: NAME.log is not a regular file of this user, or has a second hard link; a removed
// folder cannot be made again; a write has failed.
class LogFile {
 public:
  struct Limits {
    std::size_t bytes = 0;  // [bytes] maximum size of one file
    std::size_t old = 0;    // number of old files kept
  };
  // `name`: file name without `.log`.
  static error::Expected<LogFile> open(Folder folder, std::string name, Limits limits);

  error::Expected<void> append(std::string_view text);

 private:
  LogFile(Folder folder, std::string name, Limits limits)
      : folder_(std::move(folder)), name_(std::move(name)), limits_(limits) {}
  std::string name_of(std::size_t age) const;
  error::Expected<void> open_newest();
  error::Expected<void> rotate();
  error::Expected<void> return_to_path();

  Folder folder_;
  std::string name_;
  Limits limits_;
  Descriptor newest_;
  std::size_t bytes_ = 0;  // size of the newest file
};

// Opens /dev/null in place of standard streams that are closed, so that no other file gets their numbers. A write to
// such a stream still fails, because the descriptor is one for reading. Call it before any file is opened.
void occupy_standard_descriptors();

}  // namespace yars::file
