// Errors of a segment: other builds, other users, a full /dev/shm. Operations that a read-only participant may not do.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "shm/segment.hpp"
#include "tests/lib/file/refused_call.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/segment_fixture.hpp"

namespace yars::shm {
namespace {

using testing::ChildProcess;
using testing::files_of;
using testing::kLayout;
using testing::kMark;
using testing::mark_in;
using testing::SegmentTest;
using testing::set_mark;

TEST_F(SegmentTest, AnotherBuildsLayoutIsRefusedWithBothValues) {
  auto segment = open();
  const LayoutIdentity others[] = {{4, kLayout.size, kLayout.hash},
                                   {kLayout.version, kLayout.size * 2, kLayout.hash},
                                   {kLayout.version, kLayout.size, 0xfeedU}};
  const char* expected[] = {"layout version 4", "2097152 bytes", "000000000000feed"};
  for (int i = 0; i < 3; ++i) {
    const auto refused = Segment::open(name_, others[i], set_mark);
    const auto refused_reader = Segment::open_read_only(name_, others[i]);
    ASSERT_FALSE(refused);
    ASSERT_FALSE(refused_reader);
    const std::string message = refused.error().message();
    EXPECT_NE(message.find(expected[i]), std::string::npos) << message;
    EXPECT_NE(message.find("layout version 3, 1048576 bytes, record hash 000000001234abcd"), std::string::npos)
        << message;
    EXPECT_NE(message.find("--session"), std::string::npos) << message;
  }
}

TEST_F(SegmentTest, ALeftoverSegmentOfAnotherBuildIsReplaced) {
  ChildProcess([&] {
    auto own = Segment::open(name_, {9, 8192, 1}, [](void*) {});
    _exit(own ? 0 : 1);
  }).wait();
  ASSERT_EQ(files_of(name_).size(), 1u);
  auto segment = open();
  ASSERT_TRUE(segment) << segment.error().message();
  EXPECT_TRUE(segment->created());
}

TEST_F(SegmentTest, AFileWithoutASegmentIsRefusedWhileItIsLocked) {
  const std::string path = test::segment_path(name_);
  std::ofstream(path) << std::string(4096, 'x');
  ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  struct flock lock{};
  lock.l_type = F_RDLCK;
  lock.l_len = 1;
  ASSERT_EQ(fcntl(descriptor, F_OFD_SETLK, &lock), 0);
  const auto refused = open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("not a YARS segment"), std::string::npos) << refused.error().message();
  ASSERT_EQ(ftruncate(descriptor, 10), 0);
  EXPECT_FALSE(open());
  close(descriptor);
}

TEST_F(SegmentTest, OpenReadOnlyNeedsARunningSession) {
  const auto nothing = Segment::open_read_only(name_, kLayout);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message().find("none of that name"), std::string::npos);
}

TEST_F(SegmentTest, AReaderCanReadButNotLockOrWrite) {
  auto segment = std::make_unique<Segment>(std::move(*open()));
  ASSERT_TRUE(segment->try_lock(3));
  auto reader = Segment::open_read_only(name_, kLayout);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ(mark_in(const_cast<void*>(std::as_const(*reader).memory())), kMark);
  EXPECT_TRUE(reader->is_locked(3));
  EXPECT_FALSE(reader->is_locked(4));
  EXPECT_FALSE(reader->try_lock(4));
  ChildProcess writer([&] {
    if (std::freopen("/dev/null", "w", stderr) == nullptr) return 0;
    mark_in(const_cast<void*>(std::as_const(*reader).memory())) = 1;
    return 0;
  });
  EXPECT_NE(writer.wait(), 0) << "writing to the read-only mapping ends the process";
  segment.reset();
  EXPECT_TRUE(files_of(name_).empty()) << "a reader does not keep a session alive";
  EXPECT_EQ(mark_in(const_cast<void*>(std::as_const(*reader).memory())), kMark) << "but its mapping stays readable";
}

// A pipe, folder, link or another user's file has the name of the segment.
TEST_F(SegmentTest, AnythingButAFileOfThisUserAtItsNameIsNamedInTheError) {
  const std::string path = test::segment_path(name_);
  const auto refusals = [&] {
    const auto participant = open();
    const auto reader = Segment::open_read_only(name_, kLayout);
    return std::array{participant ? "" : participant.error().message(), reader ? "" : reader.error().message()};
  };
  const auto expect_named = [&](const std::string& kind) {
    for (const std::string& message : refusals()) {
      EXPECT_NE(message.find(path), std::string::npos) << message;
      EXPECT_NE(message.find("found " + kind), std::string::npos) << message;
    }
    ASSERT_EQ(remove(path.c_str()), 0);
  };
  const std::string me = " of user " + std::to_string(geteuid());
  ASSERT_EQ(mkfifo(path.c_str(), 0666), 0);
  expect_named("a pipe" + me);
  ASSERT_EQ(mkdir(path.c_str(), 0777), 0);
  expect_named("a folder" + me);
  std::filesystem::create_symlink("/etc/passwd", path);
  expect_named("a link" + me);
  std::ofstream(path) << "bait";
  if (chown(path.c_str(), 65533, 65533) != 0) GTEST_SKIP() << "chown needs root";
  expect_named("a file of user 65533");
}

// A pipe, folder or link has a possible temporary name of a creator.
TEST_F(SegmentTest, AnythingAtATemporaryNameDoesNotPreventCreation) {
  const std::string building = test::segment_path(name_) + "." + std::to_string(getpid()) + ".tmp";
  const auto makers = std::to_array<int (*)(const char*)>(
      {[](const char* path) { return mkfifo(path, 0666); }, [](const char* path) { return mkdir(path, 0777); },
       [](const char* path) { return symlink("/etc/passwd", path); }});
  for (const auto& make : makers) {
    ASSERT_EQ(make(building.c_str()), 0);
    const auto segment = open();
    EXPECT_TRUE(segment) << segment.error().message();
    ASSERT_EQ(remove(building.c_str()), 0) << "creation has left it in place";
  }
}

constexpr int kNotPermitted = 77;  // exit code of a child that lacks a permission; the test is then skipped

TEST_F(SegmentTest, WithoutOTmpfileItIsCreatedUnderARandomTemporaryName) {
  ChildProcess child([&] {
    if (!test::refuse_nameless_files()) return kNotPermitted;
    const auto segment = open();
    if (!segment || !segment->created()) return 1;
    if (files_of(name_).size() != 1) return 2;
    std::filesystem::remove(test::segment_path(name_));
    const auto again = open();
    return again && !again->created() ? 0 : 3;
  });
  const int code = child.wait();
  if (code == kNotPermitted) GTEST_SKIP() << "filters of system calls are not permitted here";
  EXPECT_EQ(code, 0);
  EXPECT_TRUE(files_of(name_).empty());
}

TEST_F(SegmentTest, AFullDevShmIsAnErrorAndLeavesNothing) {
  ChildProcess child([&] {
    const uid_t user = geteuid();
    const gid_t group = getegid();
    if (unshare(user == 0 ? CLONE_NEWNS : CLONE_NEWUSER | CLONE_NEWNS) != 0) return kNotPermitted;
    // A process in its own user namespace has no user id until one is mapped.
    if (user != 0) {
      std::ofstream("/proc/self/setgroups") << "deny";
      std::ofstream("/proc/self/uid_map") << user << " " << user << " 1";
      std::ofstream("/proc/self/gid_map") << group << " " << group << " 1";
    }
    if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return kNotPermitted;
    if (mount("tmpfs", "/dev/shm", "tmpfs", 0, "size=256k,mode=1777") != 0) return kNotPermitted;
    // A second attempt could not succeed.
    static int attempts = 0;
    creation_step = [](const char* what) { attempts += std::string_view(what) == "created" ? 1 : 0; };
    const auto refused = open();
    creation_step = nullptr;
    if (refused || attempts != 1) return 1;
    const std::string message = refused.error().message();
    std::fprintf(stderr, "%s\n", message.c_str());
    if (message.find("1048576 bytes of shared memory") == std::string::npos) return 2;
    if (message.find("No space left on device") == std::string::npos) return 3;
    return files_of(name_).empty() ? 0 : 4;
  });
  const int code = child.wait();
  if (code == kNotPermitted) GTEST_SKIP() << "a mount namespace with a small /dev/shm is not permitted here";
  EXPECT_EQ(code, 0);
}

// Programs of a set that start together create several segments and release all but one. /dev/shm may have no space for
// all of them at once.
TEST_F(SegmentTest, CreationWaitsForMemoryThatOtherProgramsRelease) {
  ChildProcess child([&] {
    if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("tmpfs", "/dev/shm", "tmpfs", 0, "size=1536k,mode=1777") != 0)
      return kNotPermitted;
    std::ofstream("/dev/shm/another") << std::string(1 << 20, ' ');
    static int unlinked = 0;
    creation_step = [](const char* what) {
      if (std::string_view(what) == "temporary removed" && ++unlinked == 3) std::filesystem::remove("/dev/shm/another");
    };
    const auto segment = open();
    creation_step = nullptr;
    if (!segment) std::fprintf(stderr, "%s\n", segment.error().message().c_str());
    return segment && segment->created() && unlinked == 4 ? 0 : 1;
  });
  const int code = child.wait();
  if (code == kNotPermitted) GTEST_SKIP() << "a mount namespace with a small /dev/shm is not permitted here";
  EXPECT_EQ(code, 0);
}

TEST_F(SegmentTest, ASessionOfAnotherUserIsNamed) {
  const std::string other = "/dev/shm/yars." + std::to_string(geteuid() + 1) + "." + name_;
  std::ofstream(other) << "a session";  // its name counts
  const auto nothing = Segment::open_read_only(name_, kLayout);
  std::filesystem::remove(other);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message().find("but one of user " + std::to_string(geteuid() + 1)), std::string::npos)
      << nothing.error().message();
}

constexpr uid_t kNobody = 65534;

TEST_F(SegmentTest, SessionsOfTwoUsersWithTheSameNameAreSeparate) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to become a second user";
  auto segment = open();
  mark_in(segment->memory()) = 1;
  ChildProcess other([&] {
    if (setuid(kNobody) != 0) return 1;
    auto own = open();
    if (!own || !own->created()) return 2;
    return mark_in(own->memory()) == kMark ? 0 : 3;
  });
  EXPECT_EQ(other.wait(), 0);
  EXPECT_EQ(mark_in(segment->memory()), 1u);
}

TEST_F(SegmentTest, AFileThatAnotherUserCreatedIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to become a second user";
  const std::string path = test::segment_path(name_);
  std::ofstream(path) << "bait";
  ASSERT_EQ(chown(path.c_str(), kNobody, kNobody), 0);
  const auto refused = open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("a file of user 65534"), std::string::npos) << refused.error().message();
  EXPECT_FALSE(Segment::open_read_only(name_, kLayout));
  EXPECT_TRUE(std::filesystem::exists(path)) << "another user's file is not removed";
}

TEST_F(SegmentTest, LayoutHashDependsOnNameVersionSizeAndOrderOfRecords) {
  const RecordIdentity base[] = {{"A", 1, 8}, {"B", 1, 16}};
  const RecordIdentity changed[][2] = {{{"A", 2, 8}, {"B", 1, 16}},
                                       {{"A", 1, 16}, {"B", 1, 16}},
                                       {{"C", 1, 8}, {"B", 1, 16}},
                                       {{"B", 1, 16}, {"A", 1, 8}}};
  for (const auto& other : changed) EXPECT_NE(layout_hash(base), layout_hash(other));
  // FNV-1a 64 over the bytes 'A', 0, version (4 bytes), size (8 bytes), computed independently.
  const RecordIdentity one[] = {{"A", 1, 8}};
  std::uint64_t hash = 14695981039346656037U;
  for (const std::uint64_t byte : {65, 0, 1, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0}) hash = (hash ^ byte) * 1099511628211U;
  EXPECT_EQ(layout_hash(one), hash);
}

}  // namespace
}  // namespace yars::shm
