// File that is continued line by line and set aside when it is full: NAME.log, then NAME.1.log (the newest), NAME.2.log
// and so on. Mode 0600. Names are opened in the folder that was checked once; nothing planted at one is written to.
// Errors: what lies at the name is no plain file of this user, or has a second name; the disk.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "lib/failure/error.hpp"
#include "lib/file/folder.hpp"

namespace yars::file {

class LogFile {
 public:
  struct Limits {
    std::size_t bytes = 0;  // of one file
    std::size_t old = 0;    // files set aside
  };
  // `name`: without `.log`.
  static failure::Expected<LogFile> open(Folder folder, std::string name, Limits limits);

  failure::Expected<void> append(std::string_view text);

 private:
  LogFile(Folder folder, std::string name, Limits limits)
      : folder_(std::move(folder)), name_(std::move(name)), limits_(limits) {}
  std::string name_of(std::size_t age) const;
  failure::Expected<void> open_newest();
  failure::Expected<void> set_aside();

  Folder folder_;
  std::string name_;
  Limits limits_;
  Descriptor newest_;
  std::size_t bytes_ = 0;
};

}  // namespace yars::file
