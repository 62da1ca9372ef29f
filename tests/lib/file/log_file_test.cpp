// Log files: rotation, rights, and refusal of files and links that others have planted at their names.
#include <gmock/gmock.h>

#include "lib/file/output_file.hpp"
#include "tests/lib/file/refused_call.hpp"
#include "tests/security/folder.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::file {
namespace {

using test::refusal_of;
using ::testing::HasSubstr;

constexpr LogFile::Limits kLimits{10, 2};  // 10 bytes per file, 2 older files

class LogFileTest : public test::SecureFolder {
 protected:
  error::Expected<LogFile> open() const {
    auto folder = Folder::make_private(folder_ / "logs");
    if (!folder) return tl::unexpected(folder.error());
    return LogFile::open(std::move(*folder), "role", kLimits);
  }
};

TEST_F(LogFileTest, ALogIsContinuedAndRotatedWhenItIsFull) {
  ASSERT_TRUE(open()->append("one\n"));
  auto log = open();
  ASSERT_TRUE(log);
  ASSERT_TRUE(log->append("two\n"));
  EXPECT_EQ(content_of(folder_ / "logs/role.log"), "one\ntwo\n");
  for (const char* line : {"three\n", "fourfour\n", "fivefive\n"}) ASSERT_TRUE(log->append(line));
  EXPECT_EQ(content_of(folder_ / "logs/role.log"), "fivefive\n");
  EXPECT_EQ(content_of(folder_ / "logs/role.1.log"), "fourfour\n");
  EXPECT_EQ(content_of(folder_ / "logs/role.2.log"), "three\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "logs/role.3.log"));
  EXPECT_EQ(mode_of(folder_ / "logs/role.log"), 0600U);
}

TEST_F(LogFileTest, ALogThatWasRemovedOrRenamedIsBegunAgain) {
  auto log = open();
  ASSERT_TRUE(log);
  ASSERT_TRUE(log->append("one\n"));
  std::filesystem::rename(folder_ / "logs/role.log", folder_ / "logs/kept.log");
  ASSERT_TRUE(log->append("two\n"));
  EXPECT_EQ(content_of(folder_ / "logs/kept.log"), "one\n");
  EXPECT_EQ(content_of(folder_ / "logs/role.log"), "two\n");
  std::filesystem::remove_all(folder_ / "logs");
  ASSERT_TRUE(log->append("three\n"));
  EXPECT_EQ(content_of(folder_ / "logs/role.log"), "three\n");
  EXPECT_EQ(mode_of(folder_ / "logs"), 0700U);
}

TEST_F(LogFileTest, APlantedLinkPipeOrFolderAtItsNameIsRefused) {
  const auto victim = write("victim", "keep this");
  const auto name = link("logs/role.log", victim);
  EXPECT_THAT(refusal_of(open()), HasSubstr("found a link"));
  std::filesystem::remove(name);
  std::filesystem::create_hard_link(victim, name);
  EXPECT_THAT(refusal_of(open()), HasSubstr("found a file with 2 names"));
  std::filesystem::remove(name);
  fifo("logs/role.log");
  EXPECT_THAT(refusal_of(open()), HasSubstr("found a pipe"));
  std::filesystem::remove(name);
  std::filesystem::create_directory(name);
  EXPECT_THAT(refusal_of(open()), HasSubstr("found a folder"));
  EXPECT_EQ(content_of(victim), "keep this");
}

TEST_F(LogFileTest, AnotherUsersFileIsNotContinued) {
  const auto name = write("logs/role.log", "bait");
  if (chown(name.c_str(), 65533, 65533) != 0) GTEST_SKIP() << "chown needs root";
  EXPECT_THAT(refusal_of(open()), HasSubstr("found a file of user 65533"));
  EXPECT_EQ(content_of(name), "bait");
}

TEST_F(LogFileTest, LinksPlantedAtTheNamesOfOldLogsAreReplaced) {
  const auto victim = write("victim", "keep this");
  link("logs/role.1.log", victim);
  auto log = open();
  ASSERT_TRUE(log);
  ASSERT_TRUE(log->append("12345678\n"));
  ASSERT_TRUE(log->append("next\n"));
  EXPECT_EQ(content_of(victim), "keep this");
  EXPECT_EQ(content_of(folder_ / "logs/role.1.log"), "12345678\n");
}

TEST_F(LogFileTest, AWriteErrorOtherThanMissingSpaceIsReportedByItsOwnReason) {
  auto log = open();
  ASSERT_TRUE(log);
  shm::testing::ChildProcess child([&] {
    if (!test::refuse_call(SYS_write, EPERM)) return 77;
    const std::string refusal = refusal_of(log->append("line\n"));
    return refusal.find("Operation not permitted") != std::string::npos && refusal.find("space") == std::string::npos
               ? 0
               : 1;
  });
  const int code = child.wait();
  if (code == 77) GTEST_SKIP() << "seccomp filters are not permitted here";
  EXPECT_EQ(code, 0);
}

TEST_F(LogFileTest, AFolderPlantedAtTheNameOfAnOldLogLetsNoLogGrow) {
  std::filesystem::create_directories(folder_ / "logs/role.1.log/x");
  auto log = open();
  ASSERT_TRUE(log);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(log->append("12345678\n"));
  EXPECT_EQ(content_of(folder_ / "logs/role.log"), "12345678\n");
}

}  // namespace
}  // namespace yars::file
