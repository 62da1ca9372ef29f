#include "shm/segment.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include "shm/creation_step.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::shm {
namespace {

using testing::ChildProcess;
using testing::SharedMemory;
using testing::wait_until;

constexpr LayoutIdentity kLayout{3, std::uint64_t{1} << 20, 0x1234abcdU};
constexpr std::uint64_t kMark = 0x5157a7eU;

std::uint64_t& mark_in(void* memory) {
  return *reinterpret_cast<std::uint64_t*>(static_cast<char*>(memory) + 4096);
}
void set_mark(void* memory) {
  mark_in(memory) = kMark;
}

std::vector<std::string> files_of(const std::string& name) {
  std::vector<std::string> found;
  const std::string prefix = segment_path(name);
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
    if (entry.path().string().starts_with(prefix)) found.push_back(entry.path());
  return found;
}

ino_t inode_at(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

// Each test has a session name of its own and leaves nothing behind, whatever happens.
class SegmentTest : public ::testing::Test {
 protected:
  SegmentTest()
      : name_("shmtest-" + std::to_string(getpid()) + "-" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name()) {}
  ~SegmentTest() override {
    for (const std::string& file : files_of(name_)) std::filesystem::remove(file);
  }
  failure::Expected<Segment> open() const { return Segment::open(name_, kLayout, set_mark); }
  const std::string name_;
};

TEST_F(SegmentTest, TheFirstCreatesTheOthersAttachTheLastUnlinks) {
  auto first = open();
  ASSERT_TRUE(first) << first.error().message();
  auto second = open();
  ASSERT_TRUE(second) << second.error().message();
  EXPECT_TRUE(first->created());
  EXPECT_FALSE(second->created());
  EXPECT_EQ(mark_in(second->memory()), kMark);
  mark_in(first->memory()) = 5;
  EXPECT_EQ(mark_in(second->memory()), 5u);
  { const Segment leaving = std::move(*first); }
  EXPECT_EQ(files_of(name_).size(), 1u);
  { const Segment leaving = std::move(*second); }
  EXPECT_TRUE(files_of(name_).empty());
}

TEST_F(SegmentTest, TheFileIsForItsOwnerOnlyAndHasItsMemory) {
  auto segment = open();
  ASSERT_TRUE(segment);
  struct stat status {};
  ASSERT_EQ(stat(segment_path(name_).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_EQ(static_cast<std::uint64_t>(status.st_size), kLayout.size);
  EXPECT_GE(static_cast<std::uint64_t>(status.st_blocks) * 512, kLayout.size) << "taken, not promised";
  EXPECT_EQ(status.st_nlink, 1u);
}

TEST_F(SegmentTest, AByteIsHeldOnceAndFreedByUnlock) {
  auto first = open();
  auto second = open();
  EXPECT_TRUE(first->try_lock(7));
  EXPECT_FALSE(first->try_lock(7)) << "also within one object";
  EXPECT_FALSE(second->try_lock(7));
  EXPECT_TRUE(second->try_lock(8));
  EXPECT_TRUE(first->is_locked(7));
  EXPECT_TRUE(second->is_locked(7));
  EXPECT_FALSE(second->is_locked(9));
  EXPECT_EQ(second->holder_pid(7), getpid());
  first->unlock(7);
  EXPECT_EQ(second->holder_pid(7), 0);
  EXPECT_TRUE(second->try_lock(7));
}

TEST_F(SegmentTest, AStoppedProcessKeepsItsLockAndADeadOneDoesNot) {
  auto segment = open();
  SharedMemory<std::atomic<int>> locked;
  ChildProcess child([&] {
    auto own = open();
    *locked = own && own->try_lock(5) ? 1 : 2;
    for (;;) pause();
  });
  ASSERT_TRUE(wait_until([&] { return *locked != 0; }));
  ASSERT_EQ(*locked, 1);
  child.send(SIGSTOP);
  EXPECT_FALSE(segment->try_lock(5));
  EXPECT_EQ(segment->holder_pid(5), child.pid());
  child.kill_now();
  EXPECT_TRUE(segment->try_lock(5));
}

TEST_F(SegmentTest, ALeftoverOfKilledProcessesIsReplaced) {
  SharedMemory<std::atomic<int>> ready;
  const auto participant = [&] {
    auto own = open();
    if (own) mark_in(own->memory()) = 99;
    ++*ready;
    for (;;) pause();
    return 0;
  };
  {
    ChildProcess first(participant);
    ChildProcess second(participant);
    ASSERT_TRUE(wait_until([&] { return *ready == 2; }));
    first.kill_now();
    second.kill_now();
  }
  ASSERT_EQ(files_of(name_).size(), 1u);
  const ino_t leftover = inode_at(segment_path(name_));
  const auto reader = Segment::open_read_only(name_, kLayout);
  ASSERT_FALSE(reader) << "a leftover is no running session";
  EXPECT_NE(reader.error().message().find("leftover"), std::string::npos);
  auto segment = open();
  ASSERT_TRUE(segment) << segment.error().message();
  EXPECT_TRUE(segment->created());
  EXPECT_EQ(mark_in(segment->memory()), kMark);
  EXPECT_NE(inode_at(segment_path(name_)), leftover);
}

TEST_F(SegmentTest, OneKilledParticipantLeavesTheSegmentToTheOthers) {
  auto segment = open();
  SharedMemory<std::atomic<int>> ready;
  ChildProcess child([&] {
    auto own = open();
    *ready = own ? 1 : 2;
    for (;;) pause();
  });
  ASSERT_TRUE(wait_until([&] { return *ready == 1; }));
  child.kill_now();
  auto third = open();
  ASSERT_TRUE(third);
  EXPECT_FALSE(third->created());
}

struct Meeting {
  std::atomic<int> ready, opened, created, failed;
  std::atomic<ino_t> inodes[8];
};

TEST_F(SegmentTest, EightProcessesThatCreateAtOnceGetOneSegment) {
  for (int round = 0; round < 15; ++round) {
    SharedMemory<Meeting> meeting;
    std::vector<ChildProcess> children;
    for (int i = 0; i < 8; ++i)
      children.emplace_back([&, i] {
        ++meeting->ready;
        while (meeting->ready < 8) sched_yield();
        auto own = open();
        if (!own) std::fprintf(stderr, "%s\n", own.error().message().c_str());
        own ? meeting->created += own->created() : ++meeting->failed;
        meeting->inodes[i] = inode_at(segment_path(name_));
        ++meeting->opened;
        return wait_until([&] { return meeting->opened == 8; }) ? 0 : 1;
      });
    for (ChildProcess& child : children) EXPECT_EQ(child.wait(), 0);
    EXPECT_EQ(meeting->created, 1);
    EXPECT_EQ(meeting->failed, 0);
    for (const auto& inode : meeting->inodes) EXPECT_EQ(inode, meeting->inodes[0]);
    EXPECT_TRUE(files_of(name_).empty()) << "eight left at once, one of them unlinked";
  }
}

TEST_F(SegmentTest, ProcessesThatComeAndGoAllTheTimeNeverFailAndLeaveNothing) {
  std::vector<ChildProcess> children;
  for (int i = 0; i < 4; ++i)
    children.emplace_back([&] {
      for (int n = 0; n < 100; ++n) {
        auto own = open();
        if (!own || mark_in(own->memory()) != kMark) return 1;
      }
      return 0;
    });
  for (ChildProcess& child : children) EXPECT_EQ(child.wait(), 0);
  EXPECT_TRUE(files_of(name_).empty());
}

// ---- Killed after every step of creation and of leaving ----

thread_local int steps_to_live = 0;
void die_in_time(const char* /*what*/) {
  if (steps_to_live-- == 0) kill(getpid(), SIGKILL);
}

TEST_F(SegmentTest, ACreatorKilledAfterAnyStepStandsInNobodysWay) {
  int steps = 0;
  for (bool alive = false; !alive; ++steps) {
    ChildProcess child([&] {
      steps_to_live = steps;
      creation_step = die_in_time;
      auto own = open();
      creation_step = nullptr;
      const int code = own ? 0 : 1;
      _exit(code);  // without leaving: as if killed
    });
    const int end = child.wait();
    ASSERT_TRUE(end == 0 || end == -SIGKILL) << end;
    alive = end == 0;
    auto segment = open();
    ASSERT_TRUE(segment) << "after step " << steps << ": " << segment.error().message();
    EXPECT_TRUE(segment->created());
    EXPECT_EQ(mark_in(segment->memory()), kMark);
    EXPECT_EQ(files_of(name_).size(), 1u) << "no temporary stays, after step " << steps;
  }
  EXPECT_GE(steps - 1, 10);
  EXPECT_TRUE(files_of(name_).empty());
}

TEST_F(SegmentTest, ALeaverKilledAfterAnyStepStandsInNobodysWay) {
  int steps = 0;
  for (bool alive = false; !alive; ++steps) {
    ChildProcess child([&] {
      auto own = open();
      steps_to_live = steps;
      creation_step = die_in_time;
      own = failure::fail("", "", "");
      return 0;
    });
    const int end = child.wait();
    ASSERT_TRUE(end == 0 || end == -SIGKILL) << end;
    alive = end == 0;
    auto segment = open();
    ASSERT_TRUE(segment) << segment.error().message();
    EXPECT_TRUE(segment->created());
  }
  EXPECT_EQ(steps - 1, 3);
  EXPECT_TRUE(files_of(name_).empty());
}

TEST_F(SegmentTest, ACreatorKilledWhileOthersRunLeavesNoTemporary) {
  auto segment = open();
  const std::string stale = segment_path(name_) + ".4000000.tmp";
  const std::string second_name = segment_path(name_) + ".4000001.tmp";
  std::ofstream(stale) << "half a segment";
  ASSERT_EQ(link(segment_path(name_).c_str(), second_name.c_str()), 0) << "killed between link and unlink";
  auto other = open();
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->created());
  EXPECT_EQ(files_of(name_).size(), 1u);
}

// ---- Refusals ----

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

TEST_F(SegmentTest, ALeftoverOfAnotherBuildIsReplaced) {
  ChildProcess([&] {
    auto own = Segment::open(name_, {9, 8192, 1}, [](void*) {});
    _exit(own ? 0 : 1);
  }).wait();
  ASSERT_EQ(files_of(name_).size(), 1u);
  auto segment = open();
  ASSERT_TRUE(segment) << segment.error().message();
  EXPECT_TRUE(segment->created());
}

TEST_F(SegmentTest, AFileThatIsNoSegmentIsRefusedWhileSomebodyUsesIt) {
  const std::string path = segment_path(name_);
  std::ofstream(path) << std::string(4096, 'x');
  ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  struct flock lock {};
  lock.l_type = F_RDLCK;
  lock.l_len = 1;
  ASSERT_EQ(fcntl(descriptor, F_OFD_SETLK, &lock), 0);
  const auto refused = open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("no YARS segment"), std::string::npos) << refused.error().message();
  ASSERT_EQ(ftruncate(descriptor, 10), 0);
  EXPECT_FALSE(open());
  close(descriptor);
}

TEST_F(SegmentTest, AReaderNeedsARunningSession) {
  const auto nothing = Segment::open_read_only(name_, kLayout);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message().find("none of that name"), std::string::npos);
}

TEST_F(SegmentTest, AReaderSeesEverythingLocksNothingAndCannotWrite) {
  auto segment = std::make_unique<Segment>(std::move(*open()));
  ASSERT_TRUE(segment->try_lock(3));
  auto reader = Segment::open_read_only(name_, kLayout);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ(mark_in(const_cast<void*>(std::as_const(*reader).memory())), kMark);
  EXPECT_TRUE(reader->is_locked(3));
  EXPECT_FALSE(reader->is_locked(4));
  EXPECT_FALSE(reader->try_lock(4));
  ChildProcess writer([&] {
    std::freopen("/dev/null", "w", stderr);
    mark_in(const_cast<void*>(std::as_const(*reader).memory())) = 1;
    return 0;
  });
  EXPECT_NE(writer.wait(), 0) << "the mapping itself refuses";
  segment.reset();
  EXPECT_TRUE(files_of(name_).empty()) << "a reader does not keep a session alive";
  EXPECT_EQ(mark_in(const_cast<void*>(std::as_const(*reader).memory())), kMark) << "but may finish reading";
}

constexpr int kNotPermitted = 77;

TEST_F(SegmentTest, AFullDevShmIsAnErrorAndLeavesNothing) {
  ChildProcess child([&] {
    if (unshare(geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWUSER | CLONE_NEWNS) != 0) return kNotPermitted;
    if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return kNotPermitted;
    if (mount("tmpfs", "/dev/shm", "tmpfs", 0, "size=256k,mode=1777") != 0) return kNotPermitted;
    const auto refused = open();
    if (refused) return 1;
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

constexpr uid_t kNobody = 65534;

TEST_F(SegmentTest, TwoUsersHaveSessionsOfTheSameNameWithoutMeeting) {
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

TEST_F(SegmentTest, AFileThatAnotherUserPutInPlaceIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to become a second user";
  const std::string path = segment_path(name_);
  std::ofstream(path) << "bait";
  ASSERT_EQ(chown(path.c_str(), kNobody, kNobody), 0);
  const auto refused = open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("a file of user 65534"), std::string::npos) << refused.error().message();
  EXPECT_FALSE(Segment::open_read_only(name_, kLayout));
  EXPECT_TRUE(std::filesystem::exists(path)) << "it is not ours to remove";
}

TEST_F(SegmentTest, AHashFollowsNameVersionAndSizeOfEveryRecord) {
  const RecordIdentity base[] = {{"A", 1, 8}, {"B", 1, 16}};
  const RecordIdentity changed[][2] = {{{"A", 2, 8}, {"B", 1, 16}},
                                       {{"A", 1, 16}, {"B", 1, 16}},
                                       {{"C", 1, 8}, {"B", 1, 16}},
                                       {{"B", 1, 16}, {"A", 1, 8}}};
  for (const auto& other : changed) EXPECT_NE(layout_hash(base), layout_hash(other));
  // FNV-1a 64 of the bytes 'A', 0, version (4), size (8), worked out apart.
  const RecordIdentity one[] = {{"A", 1, 8}};
  std::uint64_t hash = 14695981039346656037U;
  for (const std::uint64_t byte : {65, 0, 1, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0}) hash = (hash ^ byte) * 1099511628211U;
  EXPECT_EQ(layout_hash(one), hash);
}

}  // namespace
}  // namespace yars::shm
