// Tests of the processors of a program (--cpus), of its real-time priority and of its end by a signal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "runtime/process.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::runtime {
namespace {

using shm::testing::ChildProcess;
using shm::testing::SharedMemory;
using shm::testing::wait_until;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CpuList, IsNumbersAndRanges) {
  EXPECT_THAT(*parse_cpu_list("2"), ElementsAre(2));
  EXPECT_THAT(*parse_cpu_list("3,2"), ElementsAre(2, 3));
  EXPECT_THAT(*parse_cpu_list("2-4,0,3"), ElementsAre(0, 2, 3, 4));
}

TEST(CpuList, RefusesAnInvalidList) {
  for (const auto* text : {"", ",", "1,", "a", "-1", "1-", "4-2", "1 2", "99999999999", "0-999999"}) {
    const auto cpus = parse_cpu_list(text);
    ASSERT_FALSE(cpus) << text;
    EXPECT_TRUE(cpus.error().bad_usage());
    EXPECT_THAT(cpus.error().message(), HasSubstr("--cpus")) << text;
  }
}

TEST(Cpus, AnAbsentOneIsNamedAndTheAffinityIsKept) {
  cpu_set_t before;
  cpu_set_t after;
  sched_getaffinity(0, sizeof before, &before);
  const auto refusal = bind_to_cpus({0, 1001});
  ASSERT_TRUE(refusal);
  EXPECT_THAT(*refusal, HasSubstr("1001"));
  sched_getaffinity(0, sizeof after, &after);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

TEST(Cpus, AreThoseOfTheListForThisThreadAndItsChildren) {
  ChildProcess child([] {
    cpu_set_t set;
    sched_getaffinity(0, sizeof set, &set);
    int first = 0;
    while (!CPU_ISSET(static_cast<std::size_t>(first), &set)) ++first;
    if (bind_to_cpus({first})) return 1;
    int of_thread = 0;
    std::thread([&] {
      sched_getaffinity(0, sizeof set, &set);
      of_thread = CPU_COUNT(&set);
    }).join();
    return of_thread == 1 && CPU_ISSET(static_cast<std::size_t>(first), &set) ? 0 : 2;
  });
  EXPECT_EQ(child.wait(), 0);
}

TEST(Realtime, TheCallingThreadGetsThePriorityAndItsChildrenDoNot) {
  ChildProcess child([] {
    if (take_realtime_priority()) return 77;
    int of_thread = -1;
    std::thread([&] { of_thread = sched_getscheduler(0); }).join();
    if ((sched_getscheduler(0) & ~SCHED_RESET_ON_FORK) != SCHED_FIFO) return 1;
    return of_thread == SCHED_OTHER ? 0 : 2;
  });
  const int code = child.wait();
  if (code == 77) GTEST_SKIP() << "no permission to use SCHED_FIFO";
  EXPECT_EQ(code, 0);
}

// The child computes without a wait. The kernel then sends SIGXCPU, and the handler drops to normal priority.
TEST(Realtime, AnEndlessComputationDropsToNormalPriority) {
  SharedMemory<std::atomic<int>> state;  // 1: at real-time priority, 2: refused
  ChildProcess child([&] {
    *state = take_realtime_priority() ? 2 : 1;
    for (;;) state->load();
  });
  ASSERT_TRUE(wait_until([&] { return *state != 0; }));
  if (*state == 2) GTEST_SKIP() << "no permission to use SCHED_FIFO";
  EXPECT_TRUE(wait_until([&] { return sched_getscheduler(child.pid()) == SCHED_OTHER; }));
}

TEST(Signals, ARoleEndsInTheMidstOfAnEndlessComputation) {
  for (const int number : {SIGTERM, SIGINT}) {
    SharedMemory<std::atomic<int>> state;
    ChildProcess child([&] {
      install_signal_handlers();
      end_soon_after_signals();
      *state = 1;
      for (;;) state->load();
    });
    ASSERT_TRUE(wait_until([&] { return *state != 0; }));
    child.send(number);
    EXPECT_EQ(child.wait(), 0);
  }
}

}  // namespace
}  // namespace yars::runtime
