// File in /dev/shm, for readers that need a path. Errors end the fuzzer. The destructor removes the file.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "lib/error/error.hpp"

namespace yars::fuzz {

class MemoryFile {
 public:
  explicit MemoryFile(const std::string& name)
      : folder_("/dev/shm/yars-fuzz-" + std::to_string(getpid())), path_(folder_ / name) {
    std::filesystem::create_directories(folder_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { std::filesystem::remove_all(folder_); }

  const std::filesystem::path& path() const { return path_; }
  void write(std::span<const std::byte> bytes) {
    const int file = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    YARS_REQUIRE(file, >=, 0);
    YARS_REQUIRE(::write(file, bytes.data(), bytes.size()), ==, static_cast<ssize_t>(bytes.size()));
    close(file);
  }

 private:
  std::filesystem::path folder_, path_;
};

}  // namespace yars::fuzz
