// The hosts that a gateway hears, and the roles that it holds for them.
#include "gateway/exchange/hosts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway {
namespace {

using databuffer::Role;
using testing::bit;
using ::testing::HasSubstr;

class HostsTest : public testing::TwoHosts {
 protected:
  yars_net_HostSample sample(const std::string& name) {
    auto sample = from<yars_net_HostSample>(name);
    sample.segment = kBetaSegment;
    sample.layout_hash = databuffer::kLayoutIdentity.hash;
    sample.protocol = yars_net_kProtocol;
    name.copy(sample.name, sizeof sample.name - 1);
    return sample;
  }
  void receive(const yars_net_HostSample& sample) { hosts_.receive(sample, true, context_.now_ns); }
  std::uint64_t notes_with(const std::string& text) const {
    std::uint64_t found = 0;
    const auto& notes = session_.layout().notes;
    databuffer::Note note{};
    for (std::uint64_t i = 0; i < notes.total(); ++i)
      if (notes.read(i, note) && std::string_view(note.text).find(text) != std::string_view::npos) ++found;
    return found;
  }
  databuffer::NetworkStatus status() const {
    databuffer::NetworkStatus status{};
    hosts_.describe(status, context_.now_ns);
    return status;
  }
};

TEST_F(HostsTest, AHostIsHeardUntilItEnds) {
  announce("beta", bit(Role::traffic));
  ASSERT_NE(hosts_.find(host_id("beta")), nullptr);
  EXPECT_EQ(hosts_.find(host_id("beta"))->held_roles, bit(Role::traffic));
  end("beta");
  EXPECT_EQ(hosts_.find(host_id("beta")), nullptr);
  EXPECT_TRUE(hosts_.has_announced(host_id("beta")));
  EXPECT_THAT(last_note(session_), HasSubstr("host beta has left"));
  EXPECT_EQ(status().hosts[1].held_roles, 0u) << "it holds none any more";
  EXPECT_EQ(status().host_count, 2u);
  EXPECT_EQ(status().hosts[1].flags & databuffer::kHostPresent, 0u);
  EXPECT_FALSE(databuffer::validate(status()));
}

TEST_F(HostsTest, ProcessesOfAHostAreShownAndAreNoRoles) {
  auto beta = sample("beta");
  beta.held_roles = bit(Role::traffic);
  beta.processes = ~std::uint64_t{0};  // a role among them is no claim
  receive(beta);
  EXPECT_EQ(hosts_.find(host_id("beta"))->held_roles, bit(Role::traffic));
  EXPECT_EQ(status().hosts[1].held_roles, bit(Role::traffic) | shown_processes() << databuffer::kFirstProcessBit);
  EXPECT_EQ(std::popcount(shown_processes()), 3);
  hosts_.set_processes(1U << 4);
  EXPECT_EQ(status().hosts[0].held_roles, 1U << (databuffer::kFirstProcessBit + 4));
  EXPECT_FALSE(databuffer::validate(status()));
}

TEST_F(HostsTest, AHostThatIsSilentHasNotLeft) {
  announce("beta", bit(Role::traffic));
  context_.now_ns += kLease_ns + 1;
  end("beta");  // DDS tells it later than the lease of the gateways
  EXPECT_THAT(last_note(session_), HasSubstr("host beta is no longer heard"));
  EXPECT_EQ(status().hosts[1].flags & databuffer::kHostLeft, 0u);
  EXPECT_EQ(status().hosts[1].held_roles, 0u);
}

TEST_F(HostsTest, AnAnnouncementWithDamagedFieldsIsRefused) {
  auto bad = sample("beta");
  bad.name[1] = '\x1b';
  receive(bad);
  bad = sample("beta");
  std::fill(std::begin(bad.version), std::end(bad.version), 'x');
  receive(bad);
  bad = sample("beta");
  bad.host ^= 1;
  receive(bad);
  bad = sample("beta");
  bad.priority = databuffer::kMaxHostPriority + 1;
  receive(bad);
  bad = sample("");
  receive(bad);
  EXPECT_EQ(refusals(), 5u);
  EXPECT_EQ(hosts_.views().size(), 1u);
}

TEST_F(HostsTest, AnotherLayoutIsSaidAndNothingIsExchanged) {
  auto other = sample("beta");
  other.layout_hash ^= 1;
  receive(other);
  EXPECT_THAT(last_note(session_), HasSubstr("host beta has another layout"));
  EXPECT_EQ(hosts_.views().size(), 1u);
  EXPECT_FALSE(hosts_.has_announced(host_id("beta")));
  EXPECT_NE(status().hosts[1].flags & databuffer::kHostOtherLayout, 0u);
}

TEST_F(HostsTest, SamplesOfManyUnknownHostsLeaveRoomForAHost) {
  for (std::uint64_t host = 1; host <= 100; ++host) hosts_.is_new(dds::Topic::sweeps, host, 1, 0);
  announce("beta", 0);
  EXPECT_NE(hosts_.find(host_id("beta")), nullptr);
  for (std::uint64_t host = 1; host <= 100; ++host) hosts_.is_new(dds::Topic::sweeps, host, 1, 0);
  EXPECT_NE(hosts_.find(host_id("beta")), nullptr) << "a host that is heard stays";
}

TEST_F(HostsTest, AHostThatLeftMakesRoomForTheSeventeenth) {
  for (int i = 0; i < 15; ++i) announce("h" + std::to_string(i), 0);
  EXPECT_EQ(hosts_.views().size(), databuffer::kMaxHosts);
  announce("beta", 0);
  EXPECT_EQ(hosts_.find(host_id("beta")), nullptr);
  end("h3");
  announce("beta", 0);
  EXPECT_NE(hosts_.find(host_id("beta")), nullptr);
  EXPECT_EQ(hosts_.find(host_id("h3")), nullptr);
  EXPECT_FALSE(databuffer::validate(status()));
}

TEST_F(HostsTest, AnotherHostWithThisNameIsSaidWhenItStays) {
  auto ghost = sample("alpha");
  receive(ghost);
  EXPECT_EQ(status().hosts[0].flags & databuffer::kHostSameName, 0u) << "perhaps this gateway's predecessor";
  for (int i = 0; i < 4; ++i) {
    pass(kSecond_ns);
    receive(ghost);
  }
  EXPECT_THAT(last_note(session_), HasSubstr("another host is also called alpha"));
  EXPECT_NE(status().hosts[0].flags & databuffer::kHostSameName, 0u);
  pass(4 * kSecond_ns);
  EXPECT_EQ(status().hosts[0].flags & databuffer::kHostSameName, 0u) << "it has gone";
  receive(ghost);
  EXPECT_EQ(status().hosts[0].flags & databuffer::kHostSameName, 0u) << "perhaps a ghost again";
}

TEST_F(HostsTest, DifferencesOfAHostEndWhenItLeavesAndStayWhileItIsSilent) {
  auto other = sample("beta");
  other.layout_hash ^= 1;
  receive(other);
  context_.now_ns += kLease_ns + 1;
  end("beta");
  EXPECT_NE(status().hosts[1].flags & databuffer::kHostOtherLayout, 0u) << "it is silent";
  other = sample("beta");
  other.layout_hash ^= 1;
  receive(other);
  end("beta");
  EXPECT_EQ(status().hosts[1].flags & databuffer::kHostOtherLayout, 0u) << "it has left";
  other = sample("beta");
  other.layout_hash ^= 1;
  receive(other);
  EXPECT_NE(status().hosts[1].flags & databuffer::kHostOtherLayout, 0u) << "it is back";
}

// Two hosts called beta, each with samples of its own.
class SharedNameTest : public HostsTest {
 protected:
  static constexpr std::uint64_t kFirst = 11, kSecond = 13;
  void announce_as(std::uint64_t start, std::int64_t after_ns = kSecond_ns / 20) {
    context_.now_ns += after_ns;
    hosts_.exchange(context_.now_ns);
    auto beta = sample("beta");
    beta.start = start;
    receive(beta);
  }
  bool is_shared() const { return (status().hosts[1].flags & databuffer::kHostSameName) != 0; }
  std::uint64_t lines() const { return notes_with("two hosts are called beta; give each a `name` of its own"); }
};

TEST_F(SharedNameTest, TwoOtherHostsWithOneNameAreSaidOnce) {
  for (int i = 0; i < 10; ++i) announce_as(kFirst), announce_as(kSecond);
  EXPECT_EQ(lines(), 0u) << "after one second";
  for (int i = 0; i < 100; ++i) announce_as(kFirst), announce_as(kSecond);
  EXPECT_EQ(lines(), 1u);
  EXPECT_TRUE(is_shared());
  EXPECT_FALSE(databuffer::validate(status()));
}

TEST_F(SharedNameTest, ThreeHostsWithOneNameAreSaidOnce) {
  for (int i = 0; i < 50; ++i) announce_as(kFirst), announce_as(kSecond), announce_as(17);
  EXPECT_EQ(lines(), 1u);
}

TEST_F(SharedNameTest, ARestartOfAGatewayIsNone) {
  for (std::uint64_t start = 100; start < 120; ++start) {
    for (int i = 0; i < 40; ++i) announce_as(start);
    announce_as(start + 1);
    announce_as(start, 2 * kSecond_ns);  // a late sample of the process that has ended
    announce_as(start + 1);
  }
  EXPECT_EQ(lines(), 0u);
  EXPECT_FALSE(is_shared());
}

TEST_F(SharedNameTest, TheHostThatKeepsTheNameIsHeardOnceTheOtherHasGone) {
  for (int i = 0; i < 100; ++i) announce_as(kFirst), announce_as(kSecond);
  hosts_.is_new(dds::Topic::sweeps, host_id("beta"), kFirst, 1);
  hosts_.is_new(dds::Topic::sweeps, host_id("beta"), kSecond, 1);
  for (int i = 0; i < 200; ++i) announce_as(kFirst);
  EXPECT_EQ(hosts_.start_of(host_id("beta")), kFirst);
  EXPECT_TRUE(hosts_.is_new(dds::Topic::sweeps, host_id("beta"), kFirst, 2));
  EXPECT_FALSE(is_shared());
}

using RolesTest = HostsTest;

TEST_F(RolesTest, ARoleOfAnotherHostIsHeldForIt) {
  announce("beta", bit(Role::radar_model));
  EXPECT_TRUE(session_.role_is_held(Role::radar_model));
  EXPECT_TRUE(session_.is_mirrored(Role::radar_model));
  EXPECT_EQ(roles_.source(Role::radar_model), host_id("beta"));
  EXPECT_EQ(roles_.held_roles(), 0u) << "a mirrored role is not announced as this host's";
  EXPECT_FALSE(roles_.exports(Role::radar_model));
}

TEST_F(RolesTest, ARoleOfAHostThatLeftIsReleased) {
  announce("beta", bit(Role::radar_model));
  pass(kListening_ns);
  end("beta");
  pass(kSecond_ns);
  EXPECT_FALSE(session_.role_is_held(Role::radar_model));
  EXPECT_FALSE(session_.is_mirrored(Role::radar_model));
  EXPECT_EQ(roles_.source(Role::radar_model), std::nullopt);
}

TEST_F(RolesTest, ALocalHolderYieldsOnlyToAHostThatPrecedes) {
  hold(Role::state_machine);
  announce("beta", bit(Role::state_machine));
  EXPECT_FALSE(session_.must_yield(Role::state_machine));
  EXPECT_EQ(roles_.conflicts(), 1u);
  announce("aaron", bit(Role::state_machine));
  EXPECT_TRUE(session_.must_yield(Role::state_machine));
  EXPECT_FALSE(roles_.exports(Role::state_machine));
  end("aaron");
  EXPECT_FALSE(session_.must_yield(Role::state_machine));
  EXPECT_TRUE(roles_.exports(Role::state_machine));
}

TEST_F(RolesTest, ABarredRoleIsNeverHeldHere) {
  hold(Role::radar_model);
  roles_.bar(Role::radar_model);
  pass(0);
  EXPECT_EQ(roles_.held_roles(), 0u);
  EXPECT_FALSE(roles_.exports(Role::radar_model));
  EXPECT_TRUE(session_.must_yield(Role::radar_model));
  release(Role::radar_model);
  pass(2 * kSecond_ns);
  pass(2 * kSecond_ns);
  EXPECT_TRUE(session_.is_mirrored(Role::radar_model)) << "a standby of this host waits";
  EXPECT_EQ(roles_.source(Role::radar_model), std::nullopt);
  announce("beta", bit(Role::radar_model));
  EXPECT_EQ(roles_.source(Role::radar_model), host_id("beta"));
}

// Each host may have a recorder of its own.
TEST_F(RolesTest, AProcessOfThisHostGetsASharedRoleBack) {
  announce("beta", bit(Role::recorder));
  ASSERT_EQ(roles_.source(Role::recorder), host_id("beta"));
  auto recorder = open("recorder");
  std::optional<databuffer::Claim> claim;
  std::atomic<bool> ended = false;
  std::thread local([&] {
    if (auto taken = recorder.claim(Role::recorder)) claim.emplace(std::move(*taken));
    ended = true;
  });
  while (!ended) {
    pass(5'000'000);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  local.join();
  EXPECT_TRUE(claim.has_value());
  pass(400'000'000);
  EXPECT_EQ(roles_.source(Role::recorder), std::nullopt);
  EXPECT_EQ(roles_.held_roles(), bit(Role::recorder));
  claim.reset();
  pass(5'000'000);
  EXPECT_EQ(roles_.source(Role::recorder), host_id("beta")) << "mirrored again";
}

TEST_F(RolesTest, UnknownBitsOfHeldRolesChangeNothing) {
  announce("beta", 0xFFFF'FFFFU & ~bit(Role::gateway));
  EXPECT_EQ(roles_.source(Role::radar_model), host_id("beta"));
  EXPECT_FALSE(session_.role_is_held(Role::clock));
}

}  // namespace
}  // namespace yars::gateway
