// Instances of the writers of a topic, honest ones and others.
#include "gateway/dds/instance_quota.hpp"

#include <gtest/gtest.h>

namespace yars::gateway::dds {
namespace {

TEST(InstanceQuota, AWriterHasItsShareAndNoMore) {
  InstanceQuota quota(3, 100);
  for (std::uint64_t instance = 0; instance < 10; ++instance) EXPECT_EQ(quota.admits(instance, 1), instance < 3);
  EXPECT_EQ(quota.refused(), 7u);
  EXPECT_TRUE(quota.admits(2, 1)) << "a known instance";
  EXPECT_TRUE(quota.admits(50, 2)) << "another writer";
  EXPECT_EQ(quota.size(), 4u);
}

TEST(InstanceQuota, AnInstanceThatEndsLeavesRoom) {
  InstanceQuota quota(2, 100);
  for (std::uint64_t instance = 0; instance < 1000; ++instance) {
    ASSERT_TRUE(quota.admits(instance, 1));
    if (instance > 0) quota.end(instance - 1);
  }
  EXPECT_EQ(quota.size(), 1u);
  EXPECT_EQ(quota.strays(), 0u);
}

TEST(InstanceQuota, AllWritersTogetherHaveALimit) {
  InstanceQuota quota(2, 5);
  int admitted = 0;
  for (std::uint64_t writer = 0; writer < 100; ++writer)
    for (std::uint64_t instance = 0; instance < 2; ++instance) admitted += quota.admits(2 * writer + instance, writer);
  EXPECT_EQ(admitted, 5);
  quota.clear();
  EXPECT_TRUE(quota.admits(7, 99));
}

TEST(InstanceQuota, EndsOfUnknownInstancesAreCounted) {
  InstanceQuota quota(2, 5);
  ASSERT_TRUE(quota.admits(1, 1));
  quota.end(2);
  quota.end(3);
  EXPECT_EQ(quota.strays(), 2u);
  EXPECT_EQ(quota.size(), 1u);
  quota.clear();
  EXPECT_EQ(quota.strays(), 0u);
}

}  // namespace
}  // namespace yars::gateway::dds
