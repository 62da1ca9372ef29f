// Folder of the file system, opened as a file descriptor. Files are created relative to the descriptor, so a later
// change of the path, such as a new symbolic link, does not redirect them.
// Inputs: a path, which is opened one component at a time.
// Outputs: a descriptor of the last component, opened with O_PATH: it identifies the folder, but cannot list it.
// Errors: an Error that names the component that cannot be opened, and what was found there.
// Security: a symbolic link is followed only if this user or root owns it. In a sandbox that hides the owner, a link is
// also followed in folders that this user cannot write to. Source: docs/security.md.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "lib/error/error.hpp"

namespace yars::file {

// Owner of a file descriptor. The destructor closes it.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();
  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

// Mode of new files and folders. by_umask: 0644 and 0755 without the bits of the umask. user_alone: 0600 and 0700.
enum class Rights { by_umask, user_alone };

class Folder {
 public:
  // Opens an existing folder. An empty path is the working folder.
  static error::Expected<Folder> open(const std::filesystem::path& path);
  // Like open(), but also creates the missing folders of the path.
  static error::Expected<Folder> make(const std::filesystem::path& path, Rights rights = Rights::by_umask);
  // Like make() with mode 0700, but refuses an existing folder in which another user could replace files. Errors: the
  // owner is neither this user nor root (not checked if this user is root); all users may write to the folder; the
  // folder's group may write to it and is neither this user's nor root's.
  static error::Expected<Folder> make_private(const std::filesystem::path& path);

  int descriptor() const { return descriptor_.number(); }
  const std::filesystem::path& path() const { return path_; }
  // True if the path still leads to this folder. False if it was removed, renamed or replaced.
  bool is_at_path() const;
  // True if the folder is at its path, and `name` in it is the file of the descriptor `open_file`. False if that file
  // was removed or renamed.
  bool has_at_path(const std::string& name, int open_file) const;
  // Status of the file at `name`. A symbolic link is not followed. nullopt if the call fails; errno has the reason.
  std::optional<struct stat> status_of(const std::string& name) const;
  // Removes a file. A symbolic link is not followed. False if the call fails; errno has the reason.
  bool remove(const std::string& name) const;
  // Renames a file within the folder and replaces `new_name`. False if the call fails; errno has the reason.
  bool rename_file(const std::string& name, const std::string& new_name) const;

 private:
  friend class FolderWalk;
  Folder(Descriptor descriptor, std::filesystem::path path)
      : descriptor_(std::move(descriptor)), path_(std::move(path)) {}

  Descriptor descriptor_;
  std::filesystem::path path_;
};

// Kind of a file for messages: "a file", "a folder", "a link", "a pipe", "a socket", "a device".
const char* name_of_kind(mode_t mode);

}  // namespace yars::file
