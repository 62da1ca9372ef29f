// Folder of real elevation files, shared/data beside the source tree. YARS_NEEDS_SHARED_DATA() skips a test if the
// folder is absent.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

namespace yars::test {

inline std::filesystem::path shared_data() {
  return std::filesystem::path(YARS_SOURCE_DIR).parent_path() / "shared" / "data";
}

}  // namespace yars::test

#define YARS_NEEDS_SHARED_DATA()                                     \
  do {                                                               \
    if (!std::filesystem::is_directory(::yars::test::shared_data())) \
      GTEST_SKIP() << "needs ../shared/data, which is absent here";  \
  } while (false)
