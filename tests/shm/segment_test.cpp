// Segment: creation, participation and removal, lock bytes, and processes killed at any step of creating and leaving.
#include "shm/segment.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdio>
#include <fstream>
#include <vector>

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
using testing::SharedMemory;
using testing::wait_until;

ino_t inode_at(const std::string& path) {
  struct stat status{};
  return stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

TEST_F(SegmentTest, TheFirstCreatesOthersJoinAndTheLastUnlinks) {
  auto first = open();
  ASSERT_TRUE(first) << first.error().message();
  auto second = open();
  ASSERT_TRUE(second) << second.error().message();
  EXPECT_TRUE(first->created());
  EXPECT_FALSE(second->created());
  EXPECT_EQ(mark_in(second->memory()), kMark);
  mark_in(first->memory()) = 5;
  EXPECT_EQ(mark_in(second->memory()), 5u);
  {
    const Segment leaving = std::move(*first);
  }
  EXPECT_EQ(files_of(name_).size(), 1u);
  {
    const Segment leaving = std::move(*second);
  }
  EXPECT_TRUE(files_of(name_).empty());
}

TEST_F(SegmentTest, TheFileHasMode0600AndAllocatedMemory) {
  auto segment = open();
  ASSERT_TRUE(segment);
  struct stat status{};
  ASSERT_EQ(stat(test::segment_path(name_).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_EQ(static_cast<std::uint64_t>(status.st_size), kLayout.size);
  EXPECT_GE(static_cast<std::uint64_t>(status.st_blocks) * 512, kLayout.size) << "the file is not sparse";
  EXPECT_EQ(status.st_nlink, 1u);
}

TEST_F(SegmentTest, ALockByteHasOneHolderUntilUnlock) {
  auto first = open();
  auto second = open();
  EXPECT_TRUE(first->try_lock(7));
  EXPECT_FALSE(first->try_lock(7)) << "also for the holder itself";
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

TEST_F(SegmentTest, ALeftoverSegmentOfKilledProcessesIsReplaced) {
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
  const ino_t leftover = inode_at(test::segment_path(name_));
  const auto reader = Segment::open_read_only(name_, kLayout);
  ASSERT_FALSE(reader) << "a leftover is no running session";
  EXPECT_NE(reader.error().message().find("leftover"), std::string::npos);
  auto segment = open();
  ASSERT_TRUE(segment) << segment.error().message();
  EXPECT_TRUE(segment->created());
  EXPECT_EQ(mark_in(segment->memory()), kMark);
  EXPECT_NE(inode_at(test::segment_path(name_)), leftover);
}

TEST_F(SegmentTest, AfterOneParticipantIsKilledOthersStillJoinTheSegment) {
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

// Shared counts of the processes.
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
        meeting->inodes[i] = inode_at(test::segment_path(name_));
        ++meeting->opened;
        return wait_until([&] { return meeting->opened == 8; }) ? 0 : 1;
      });
    for (ChildProcess& child : children) EXPECT_EQ(child.wait(), 0);
    EXPECT_EQ(meeting->created, 1);
    EXPECT_EQ(meeting->failed, 0);
    for (const auto& inode : meeting->inodes) EXPECT_EQ(inode, meeting->inodes[0]);
    EXPECT_TRUE(files_of(name_).empty()) << "eight processes left at once; one of them unlinked the file";
  }
}

TEST_F(SegmentTest, ProcessesThatJoinAndLeaveRepeatedlyNeverFailAndLeaveNoFile) {
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

// ---- Processes killed after each step of creating and of leaving ----

thread_local int steps_left = 0;
void die_if_due(const char* /*what*/) {
  if (steps_left-- == 0) kill(getpid(), SIGKILL);
}

TEST_F(SegmentTest, AfterACreatorIsKilledAtAnyStepASegmentCanBeCreated) {
  int steps = 0;
  for (bool alive = false; !alive; ++steps) {
    ChildProcess child([&] {
      steps_left = steps;
      creation_step = die_if_due;
      auto own = open();
      creation_step = nullptr;
      const int code = own ? 0 : 1;
      _exit(code);  // without leaving, as if killed
    });
    const int end = child.wait();
    ASSERT_TRUE(end == 0 || end == -SIGKILL) << end;
    alive = end == 0;
    auto segment = open();
    ASSERT_TRUE(segment) << "after step " << steps << ": " << segment.error().message();
    EXPECT_TRUE(segment->created());
    EXPECT_EQ(mark_in(segment->memory()), kMark);
    EXPECT_EQ(files_of(name_).size(), 1u) << "no temporary file remains, after step " << steps;
  }
  EXPECT_GE(steps - 1, 10);
  EXPECT_TRUE(files_of(name_).empty());
}

TEST_F(SegmentTest, AfterALeavingProcessIsKilledAtAnyStepASegmentCanBeCreated) {
  int steps = 0;
  for (bool alive = false; !alive; ++steps) {
    ChildProcess child([&] {
      auto own = open();
      steps_left = steps;
      creation_step = die_if_due;
      own = error::fail("", "", "");  // destroys the Segment
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

TEST_F(SegmentTest, AJoiningProcessRemovesTemporaryFilesOfKilledCreators) {
  auto segment = open();
  const std::string stale = test::segment_path(name_) + ".4000000.tmp";
  const std::string second_name = test::segment_path(name_) + ".4000001.tmp";
  std::ofstream(stale) << "half a segment";
  // A creator killed between link() and unlink() leaves a second name.
  ASSERT_EQ(link(test::segment_path(name_).c_str(), second_name.c_str()), 0) << "the second name cannot be made";
  auto other = open();
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->created());
  EXPECT_EQ(files_of(name_).size(), 1u);
}

}  // namespace
}  // namespace yars::shm
