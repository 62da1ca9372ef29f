// Which host has a role: the rule by which hosts agree without asking each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "gateway/host_agreement.hpp"
#include "tests/gateway/random_seed.hpp"

namespace yars::gateway {
namespace {

const HostView* holder_of(std::span<const HostView> hosts, unsigned role) {
  return preceding(hosts, [role](const HostView& host) { return (host.held_roles >> role & 1U) != 0; });
}

const HostView* clock_owner(std::span<const HostView> hosts) {
  return preceding(hosts, [](const HostView& host) { return host.owns_clock; });
}

HostView host(const std::string& name, std::uint32_t priority = 0, std::uint32_t group = 1, std::uint32_t roles = 0) {
  return {std::hash<std::string>{}(name), name, priority, group, roles, false};
}

// Few values of each property, so that most hosts are equal in some.
std::vector<HostView> random_hosts(std::mt19937_64& random, std::size_t count) {
  std::vector<HostView> hosts;
  for (std::size_t i = 0; i < count; ++i) {
    const auto below = [&random](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
    HostView view = host(std::string(1, static_cast<char>('a' + random() % 4)), below(3), 1 + below(3), below(8));
    view.id = i + 1;
    view.owns_clock = random() % 2 == 0;
    hosts.push_back(view);
  }
  std::ranges::shuffle(hosts, random);
  return hosts;
}

class AuthorityProperty : public ::testing::Test {
 protected:
  static constexpr int kRuns = 2000;
  const std::uint64_t seed_ = testing::random_seed();
  const ::testing::ScopedTrace trace_{__FILE__, __LINE__, "YARS_SEED=" + std::to_string(seed_)};
  std::mt19937_64 random_{seed_};
};

TEST_F(AuthorityProperty, TheOrderIsTotal) {
  for (int run = 0; run < kRuns; ++run) {
    const auto hosts = random_hosts(random_, 3);
    EXPECT_FALSE(precedes(hosts[0], hosts[0])) << "irreflexive";
    EXPECT_NE(precedes(hosts[0], hosts[1]), precedes(hosts[1], hosts[0])) << "of two hosts exactly one precedes";
    if (precedes(hosts[0], hosts[1]) && precedes(hosts[1], hosts[2])) {
      EXPECT_TRUE(precedes(hosts[0], hosts[2])) << "transitive";
    }
  }
}

TEST_F(AuthorityProperty, EveryHostWithTheSameViewsNamesTheSameHolder) {
  for (int run = 0; run < kRuns; ++run) {
    auto hosts = random_hosts(random_, 1 + random_() % 16);
    for (unsigned role = 0; role < 3; ++role) {
      const HostView* first = holder_of(hosts, role);
      const std::uint64_t expected = first == nullptr ? 0 : first->id;
      const HostView* owner = clock_owner(hosts);
      const std::uint64_t expected_owner = owner == nullptr ? 0 : owner->id;
      std::ranges::shuffle(hosts, random_);  // each host has itself first
      const HostView* second = holder_of(hosts, role);
      EXPECT_EQ(second == nullptr ? 0 : second->id, expected);
      EXPECT_TRUE(second == nullptr || (second->held_roles >> role & 1U) != 0);
      owner = clock_owner(hosts);
      EXPECT_EQ(owner == nullptr ? 0 : owner->id, expected_owner);
    }
  }
}

TEST_F(AuthorityProperty, AHostWithoutTheRoleDoesNotChangeTheHolder) {
  for (int run = 0; run < kRuns; ++run) {
    auto hosts = random_hosts(random_, 6);
    const HostView* before = holder_of(hosts, 1);
    const std::uint64_t expected = before == nullptr ? 0 : before->id;
    HostView more = host("0", 1000, 16, 0);
    hosts.insert(hosts.begin() + static_cast<std::ptrdiff_t>(random_() % hosts.size()), more);
    const HostView* after = holder_of(hosts, 1);
    EXPECT_EQ(after == nullptr ? 0 : after->id, expected);
  }
}

TEST_F(AuthorityProperty, RanksAreDifferentAndCountFromZero) {
  for (int run = 0; run < kRuns; ++run) {
    const auto hosts = random_hosts(random_, 8);
    std::vector<std::size_t> ranks;
    for (const HostView& self : hosts) ranks.push_back(rank_of(hosts, self));
    std::ranges::sort(ranks);
    for (std::size_t i = 0; i < ranks.size(); ++i) EXPECT_EQ(ranks[i], i);
  }
}

TEST(Authority, PriorityComesFirst) {
  EXPECT_TRUE(precedes(host("z", 2, 1), host("a", 1, 9)));
}

TEST(Authority, AfterAPartitionTheLargerPartKeepsTheRole) {
  const std::vector hosts{host("a", 0, 1, 1), host("x", 0, 3, 1), host("y", 0, 3), host("z", 0, 3)};
  EXPECT_EQ(holder_of(hosts, 0)->name, "x");
}

TEST(Authority, OfEqualPartsTheFirstNameKeepsTheRole) {
  const std::vector hosts{host("d", 0, 2, 1), host("b", 0, 2, 1), host("a", 0, 2)};
  EXPECT_EQ(holder_of(hosts, 0)->name, "b");
}

// a and d were one part, b and c the other; both had both roles and a clock. No part has a majority.
TEST(Authority, TwoHostsAgainstTwoAgreeForEachRoleByName) {
  constexpr std::uint32_t kModel = 1U << 0, kMachine = 1U << 1;
  std::vector hosts{host("a", 0, 2, kModel), host("b", 0, 2, kMachine), host("c", 0, 2, kModel),
                    host("d", 0, 2, kMachine)};
  hosts[0].owns_clock = hosts[1].owns_clock = true;
  std::ranges::sort(hosts, {}, &HostView::name);
  do {  // each host has another order of the others
    EXPECT_EQ(holder_of(hosts, 0)->name, "a");
    EXPECT_EQ(holder_of(hosts, 1)->name, "b");
    EXPECT_EQ(clock_owner(hosts)->name, "a");
    EXPECT_EQ(
        std::ranges::count_if(hosts, [&](const HostView& self) { return holder_of(hosts, 0)->name == self.name; }), 1);
  } while (std::ranges::next_permutation(hosts, {}, &HostView::name).found);
  std::ranges::find(hosts, "d", &HostView::name)->priority = 1;
  EXPECT_EQ(holder_of(hosts, 1)->name, "d") << "priority decides before the name";
  EXPECT_EQ(holder_of(hosts, 0)->name, "a") << "for its own roles alone";
}

// A host that has met the other part 1 s ago says 4, and the part that meets it later still says 2.
TEST(Authority, AHostThatHeardAllDoesNotLoseToOneThatHeardHalf) {
  const std::vector hosts{host("a", 0, 2, 1), host("c", 0, 4, 1)};
  EXPECT_EQ(holder_of(hosts, 0)->name, "c");
}

TEST(Authority, WithoutAHolderThereIsNone) {
  EXPECT_EQ(holder_of(std::vector{host("a"), host("b")}, 1), nullptr);
  EXPECT_EQ(holder_of({}, 1), nullptr);
  EXPECT_EQ(clock_owner(std::vector{host("a")}), nullptr);
}

TEST(Vacancy, IsTakenAtOnceByTheFirstAndLaterByTheNext) {
  Vacancy first, second;
  EXPECT_TRUE(first.may_take(true, 0, 5 * kTurn_ns));
  EXPECT_FALSE(second.may_take(true, 2, 5 * kTurn_ns));
  EXPECT_FALSE(second.may_take(true, 2, 7 * kTurn_ns - 1));
  EXPECT_TRUE(second.may_take(true, 2, 7 * kTurn_ns));
}

TEST(Vacancy, ANewHolderBeginsTheWaitAgain) {
  Vacancy vacancy;
  EXPECT_FALSE(vacancy.may_take(true, 1, 0));
  EXPECT_FALSE(vacancy.may_take(false, 1, 2 * kTurn_ns)) << "a host has it";
  EXPECT_FALSE(vacancy.may_take(true, 1, 3 * kTurn_ns));
  EXPECT_TRUE(vacancy.may_take(true, 1, 4 * kTurn_ns));
}

}  // namespace
}  // namespace yars::gateway
