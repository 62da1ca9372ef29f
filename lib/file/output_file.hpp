// Files that YARS writes: new ones, renamed into place when whole, and logs that are continued.
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

// File in the making: written beside its place, where nobody meets half of it, and renamed into place when it is
// whole. It has no name meanwhile where the filesystem can do that (O_TMPFILE), else a random one.
// What was at its place is replaced, never written through: a plain file, or a link to one (the link itself goes).
// A pipe, a socket, a folder or a link to another thing is an error. A device is written to directly.
// Errors: the folder (folder.hpp), what lies at the place, the disk. What was there before stays then.
enum class Existing { overwritten, refused };  // what lies at the place already; a device is always written to

class NewFile {
 public:
  static error::Expected<NewFile> create(const std::filesystem::path& path, Rights rights = Rights::by_umask);
  static error::Expected<NewFile> create(std::shared_ptr<const Folder> folder, const std::string& name,
                                         Rights rights = Rights::by_umask, Existing existing = Existing::overwritten);
  NewFile(NewFile&&) noexcept;
  NewFile& operator=(NewFile&&) noexcept;
  ~NewFile();  // takes back what has not been placed

  std::string shown() const { return (folder_->path() / name_).string(); }  // its path, for messages
  // For libraries that write by themselves; place() tells whether all went well.
  std::FILE* stream() { return stream_.get(); }
  int descriptor() const;  // -1 once it is finished
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  // Gives it its name; it may be written further, as a recording is.
  error::Expected<void> place();
  // What is buffered goes to the system. An error: a write has failed.
  error::Expected<void> flush();
  // place() and the end of it.
  error::Expected<void> finish();

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  NewFile(std::shared_ptr<const Folder> folder, std::string name)
      : folder_(std::move(folder)), name_(std::move(name)) {}
  error::Expected<void> check_place();
  error::Expected<void> move_to_place();
  error::Expected<void> open_beside(mode_t mode);
  error::Expected<void> open_device();
  error::Expected<void> give_beside_a_name();

  std::shared_ptr<const Folder> folder_;
  std::string name_;
  std::string beside_;  // its random name for the time being; empty while it has none
  std::unique_ptr<std::FILE, Close> stream_;
  Existing existing_ = Existing::overwritten;
  bool placed_ = false;
  bool device_ = false;
};

// The whole file at once.
error::Expected<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                                 Rights rights = Rights::by_umask);
error::Expected<void> write_file(const std::filesystem::path& path, std::string_view text,
                                 Rights rights = Rights::by_umask);
// And the folders on the way to it; its path.
error::Expected<std::filesystem::path> write_file_and_folders(const std::filesystem::path& path,
                                                              std::span<const std::byte> bytes);

// File that is continued line by line and set aside when it is full: NAME.log, then NAME.1.log (the newest), NAME.2.log
// and so on. Mode 0600. Names are opened in the folder that was checked once; nothing planted at one is written to.
// Errors: what lies at the name is no plain file of this user, or has a second name; the disk.
class LogFile {
 public:
  struct Limits {
    std::size_t bytes = 0;  // of one file
    std::size_t old = 0;    // files set aside
  };
  // `name`: without `.log`.
  static error::Expected<LogFile> open(Folder folder, std::string name, Limits limits);

  error::Expected<void> append(std::string_view text);

 private:
  LogFile(Folder folder, std::string name, Limits limits)
      : folder_(std::move(folder)), name_(std::move(name)), limits_(limits) {}
  std::string name_of(std::size_t age) const;
  error::Expected<void> open_newest();
  error::Expected<void> set_aside();

  Folder folder_;
  std::string name_;
  Limits limits_;
  Descriptor newest_;
  std::size_t bytes_ = 0;
};

}  // namespace yars::file
