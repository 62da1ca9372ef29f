// Fixture: a session name that is unique to the test and the run. Removes the segment that a failed test leaves behind.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "shm/segment.hpp"
#include "tests/shm/segment_path.hpp"

namespace yars::databuffer::testing {

class SessionTest : public ::testing::Test {
 protected:
  SessionTest() : name_(std::string("t").append(std::to_string(getpid())) + "-" + std::to_string(++count)) {}
  ~SessionTest() override { unlink(path().c_str()); }
  std::string path() const { return test::segment_path(name_); }
  bool file_exists() const { return access(path().c_str(), F_OK) == 0; }

  const std::string name_;

 private:
  inline static int count = 0;
};

}  // namespace yars::databuffer::testing
