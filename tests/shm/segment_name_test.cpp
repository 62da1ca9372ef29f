// A segment in use whose name another program has removed, as systemd-logind does with RemoveIPC: new participants find
// it, and its claims hold.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "shm/segment_file.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/segment_fixture.hpp"

namespace yars::shm {
namespace {

using testing::ChildProcess;
using testing::files_of;
using testing::kLayout;
using testing::mark_in;
using testing::SharedMemory;
using testing::wait_until;

class SegmentName : public testing::SegmentTest {
 protected:
  void remove_name() const { std::filesystem::remove(test::segment_path(name_)); }
};

TEST_F(SegmentName, ANewParticipantFindsTheSegmentThatLostItsName) {
  auto creator = open();
  auto second = open();
  ASSERT_TRUE(creator && second);
  EXPECT_TRUE(creator->has_name());
  remove_name();
  EXPECT_FALSE(creator->has_name());
  mark_in(creator->memory()) = 77;
  auto third = open();
  ASSERT_TRUE(third) << third.error().message();
  EXPECT_FALSE(third->created());
  EXPECT_EQ(mark_in(third->memory()), 77u);
  mark_in(third->memory()) = 78;
  EXPECT_EQ(mark_in(second->memory()), 78u);
  const auto reader = Segment::open_read_only(name_, kLayout);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_FALSE(reader->has_name());
  EXPECT_TRUE(files_of(name_).empty()) << "no second segment was created";
}

TEST_F(SegmentName, ClaimsHoldWithoutAName) {
  auto first = open();
  ASSERT_TRUE(first && first->try_lock(3));
  remove_name();
  auto second = open();
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->is_locked(3));
  EXPECT_FALSE(second->try_lock(3));
  EXPECT_EQ(second->holder_pid(3), getpid());
  first->unlock(3);
  EXPECT_TRUE(second->try_lock(3));
}

TEST_F(SegmentName, ASegmentThatOnlyItsCreatorHasOpenIsFoundByAnotherProcess) {
  SharedMemory<std::atomic<int>> ready;
  ChildProcess child([&] {
    auto own = open();
    if (!own) return 1;
    mark_in(own->memory()) = 99;
    ++*ready;
    for (;;) pause();
    return 0;
  });
  ASSERT_TRUE(wait_until([&] { return *ready == 1; }));
  EXPECT_TRUE(nameless_files(test::segment_path(name_)).empty()) << "the segment still has its name";
  remove_name();
  EXPECT_EQ(nameless_files(test::segment_path(name_)).size(), 1u);
  auto here = open();
  ASSERT_TRUE(here);
  EXPECT_FALSE(here->created());
  EXPECT_EQ(mark_in(here->memory()), 99u);
}

TEST_F(SegmentName, ASegmentWithoutParticipantsIsNotJoinedThoughAReaderHasItMapped) {
  auto owner = open();
  ASSERT_TRUE(owner);
  mark_in(owner->memory()) = 5;
  const auto reader = Segment::open_read_only(name_, kLayout);
  ASSERT_TRUE(reader);
  remove_name();
  {
    const Segment leaving = std::move(*owner);
  }
  ASSERT_EQ(nameless_files(test::segment_path(name_)).size(), 1u) << "the reader's file";
  auto next = open();
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->created());
  EXPECT_EQ(mark_in(next->memory()), testing::kMark);
  EXPECT_FALSE(reader->has_name()) << "the name belongs to another segment";
}

// The name of another session may begin with the name of this session.
TEST_F(SegmentName, ANamelessSegmentWithALongerNameIsNotJoined) {
  auto other = Segment::open(name_ + "-b", kLayout, testing::set_mark);
  ASSERT_TRUE(other);
  std::filesystem::remove(test::segment_path(name_ + "-b"));
  EXPECT_TRUE(nameless_files(test::segment_path(name_)).empty());
  auto mine = open();
  ASSERT_TRUE(mine);
  EXPECT_TRUE(mine->created());
}

TEST_F(SegmentName, AfterAllParticipantsHaveLeftTheNextSegmentIsNewAndHasItsName) {
  {
    auto first = open();
    ASSERT_TRUE(first);
    mark_in(first->memory()) = 5;
    remove_name();
    auto second = open();
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->created());
  }
  EXPECT_TRUE(files_of(name_).empty());
  auto next = open();
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->created());
  EXPECT_TRUE(next->has_name());
  EXPECT_EQ(mark_in(next->memory()), testing::kMark);
}

}  // namespace
}  // namespace yars::shm
