// Fixture: temporary folder with files for a test. Watchdog: SIGALRM ends the test program if a reader hangs for 60 s.
#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace yars::test {

class SecureFolder : public testing::Test {
 protected:
  SecureFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "yars-security-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    folder_ = std::filesystem::canonical(pattern);
    constexpr unsigned kWatchdog_s = 60;
    alarm(kWatchdog_s);
  }
  ~SecureFolder() override {
    alarm(0);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  // Writes a sparse file: `size` bytes, of which only `begin` occupies the disk; the rest are zeros.
  std::filesystem::path sparse(const std::string& name, std::uintmax_t size, std::string_view begin = {}) const {
    const std::filesystem::path path = write(name, begin);
    std::filesystem::resize_file(path, size);
    return path;
  }
  std::filesystem::path fifo(const std::string& name) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    return path;
  }
  std::filesystem::path link(const std::string& name, const std::filesystem::path& target) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::filesystem::create_symlink(target, path);
    return path;
  }
  // Permission bits of a path; a link is not followed.
  static unsigned mode_of(const std::filesystem::path& path) {
    struct stat status{};
    return lstat(path.c_str(), &status) == 0 ? status.st_mode & 07777U : 0U;
  }
  static std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder_;
};

// The error message of a reader's result.
template <class Expected>
std::string refusal_of(const Expected& result) {
  return result ? "none: it was read" : result.error().message();
}

}  // namespace yars::test
