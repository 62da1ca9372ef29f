// Fixture: a segment with its own name for each test. A number in its memory shows whether it was initialized.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shm/segment.hpp"
#include "tests/shm/segment_path.hpp"

namespace yars::shm::testing {

inline constexpr LayoutIdentity kLayout{3, std::uint64_t{1} << 20, 0x1234abcdU};
inline constexpr std::uint64_t kMark = 0x5157a7eU;  // arbitrary

// The mark: a number behind the segment's header, kMark after initialization. Tests change it to recognize a segment.
inline std::uint64_t& mark_in(void* memory) {
  return *reinterpret_cast<std::uint64_t*>(static_cast<char*>(memory) + 4096);
}
inline void set_mark(void* memory) {
  mark_in(memory) = kMark;
}

// Files in /dev/shm whose names begin like the segment's name, temporary files included.
inline std::vector<std::string> files_of(const std::string& name) {
  std::vector<std::string> found;
  const std::string prefix = test::segment_path(name);
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
    if (entry.path().string().starts_with(prefix)) found.push_back(entry.path());
  return found;
}

// Each test has its own session name. The destructor removes the files of a failed test, too.
class SegmentTest : public ::testing::Test {
 protected:
  SegmentTest()
      : name_("shmtest-" + std::to_string(getpid()) + "-" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name()) {}
  ~SegmentTest() override {
    for (const std::string& file : files_of(name_)) std::filesystem::remove(file);
  }
  error::Expected<Segment> open() const { return Segment::open(name_, kLayout, set_mark); }
  const std::string name_;
};

}  // namespace yars::shm::testing
