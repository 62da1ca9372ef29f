// Folder held by a descriptor, so that names in it cannot be led elsewhere while files are made.
// The way to it is walked one step at a time. A symbolic link on the way is followed only when this user or root
// owns it: in a folder that others may write to, anybody may plant one.
// Errors name the step that failed and what lies there.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "lib/error/error.hpp"

namespace yars::file {

// An open file of the system; closed when it goes.
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

// Who may read a new file or enter a new folder: all whom the umask lets (0644, 0755), or this user (0600, 0700).
enum class Rights { by_umask, user_alone };

class Folder {
 public:
  // `path` may be empty: the working folder.
  static error::Expected<Folder> open(const std::filesystem::path& path);
  // Makes what is missing on the way.
  static error::Expected<Folder> make(const std::filesystem::path& path, Rights rights = Rights::by_umask);
  // As make, for what is the user's alone. An error: any user may write to it, or it is another user's.
  static error::Expected<Folder> make_private(const std::filesystem::path& path);

  int descriptor() const { return descriptor_.number(); }
  const std::filesystem::path& path() const { return path_; }
  // What lies at a name, a link itself; nullopt with errno set.
  std::optional<struct stat> look(const std::string& name) const;
  // Takes a file away, a link itself. False with errno set.
  bool remove(const std::string& name) const;
  // Gives a file another name; what had that name goes. False with errno set.
  bool set_aside(const std::string& name, const std::string& other) const;

 private:
  friend class FolderWalk;
  Folder(Descriptor descriptor, std::filesystem::path path)
      : descriptor_(std::move(descriptor)), path_(std::move(path)) {}

  Descriptor descriptor_;
  std::filesystem::path path_;
};

// "a pipe", "a folder", "a link" and so on.
const char* name_of_kind(mode_t mode);

}  // namespace yars::file
