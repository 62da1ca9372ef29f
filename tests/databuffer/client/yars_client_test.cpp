// Tests of libyars-client alone: what yars.h cannot do, and calls that a caller should not make.
#include "databuffer/client/yars_client.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "databuffer/session/session.hpp"
#include "tests/databuffer/session/session_name.hpp"
#include "tests/databuffer/session/set_clock.hpp"

namespace yars::databuffer {
namespace {

// Arguments for every function that a client has.
struct Records {
  yars_ownship ownship{};
  yars_nav nav{};
  yars_traffic traffic{};
  yars_input_event event{};
  yars_clock clock{};
  yars_radar_state state{};
  yars_outputs outputs{};
  yars_model_status status{};
  yars_caption caption{};
  yars_glass_frame frame{};
  const unsigned char* pixels = nullptr;
  yars_client_cursor cursor{};
  yars_sweep sweep{};
};

// Every function with a client and the records; without records with NULL in their place. Results in order.
std::vector<int> call_all(yars_client* c, Records* r) {
  return {yars_client_heartbeat(c),
          r == nullptr ? YARS_CLIENT_ARGUMENT : yars_client_claim_ownship(c, 1),
          yars_client_publish_ownship(c, r == nullptr ? nullptr : &r->ownship),
          yars_client_publish_nav(c, r == nullptr ? nullptr : &r->nav),
          r == nullptr ? YARS_CLIENT_ARGUMENT : yars_client_claim_traffic(c),
          yars_client_publish_traffic(c, r == nullptr ? nullptr : &r->traffic),
          yars_client_claim_input(c, r == nullptr ? nullptr : "source"),
          yars_client_push_event(c, r == nullptr ? nullptr : &r->event),
          yars_client_read_clock(c, r == nullptr ? nullptr : &r->clock),
          yars_client_read_radar_state(c, r == nullptr ? nullptr : &r->state),
          yars_client_read_outputs(c, r == nullptr ? nullptr : &r->outputs),
          yars_client_read_model_status(c, r == nullptr ? nullptr : &r->status),
          yars_client_read_caption(c, r == nullptr ? nullptr : &r->caption),
          yars_client_read_frame(c, 0, r == nullptr ? nullptr : &r->frame, r == nullptr ? nullptr : &r->pixels),
          yars_client_read_sweep(c, r == nullptr ? nullptr : &r->cursor, r == nullptr ? nullptr : &r->sweep)};
}

class YarsClient : public testing::SessionTest {
 protected:
  YarsClient() : session_(std::move(*Session::open(name_, "maker"))), client_(attached()) {}
  ~YarsClient() override { yars_client_detach(client_); }
  yars_client* attached() {
    yars_client* client = nullptr;
    EXPECT_EQ(yars_client_attach(name_.c_str(), "tester", &client), 0) << yars_client_error();
    return client;
  }
  // Expects that every function refuses the client, and that the last of them says this.
  void expect_unusable(yars_client* client, const std::string& fragment) {
    Records records;
    for (const int result : call_all(client, &records)) EXPECT_EQ(result, YARS_CLIENT_ARGUMENT);
    EXPECT_EQ(yars_client_set_runs(client), 0);
    EXPECT_EQ(yars_client_sim_time_ns(client), 0);
    EXPECT_EQ(yars_client_epoch(client), 0u);
    EXPECT_NE(std::string(yars_client_error()).find(fragment), std::string::npos) << yars_client_error();
  }

  Session session_;
  yars_client* client_;
};

TEST_F(YarsClient, ANullClientIsAnError) {
  expect_unusable(nullptr, "expected an address as `client`, found NULL");
  yars_client_detach(nullptr);
}

TEST_F(YarsClient, AClientThatWasDetachedIsAnError) {
  yars_client* const other = attached();
  yars_client_detach(client_);
  expect_unusable(client_, "expected a client that is attached, found one that was detached; call yars_client_attach");
  yars_client_detach(client_);
  EXPECT_EQ(yars_client_claim_ownship(other, 1), 0) << "the other client still works: " << yars_client_error();
  yars_client* const later = attached();
  expect_unusable(client_, "detached");
  yars_client_detach(other);
  yars_client_detach(later);
}

TEST_F(YarsClient, NullArgumentsAreErrors) {
  yars_client* none = client_;
  EXPECT_EQ(yars_client_attach(nullptr, "tester", &none), YARS_CLIENT_ARGUMENT);
  EXPECT_EQ(none, nullptr);
  EXPECT_EQ(yars_client_attach(name_.c_str(), nullptr, &none), YARS_CLIENT_ARGUMENT);
  EXPECT_EQ(yars_client_attach(name_.c_str(), "tester", nullptr), YARS_CLIENT_ARGUMENT);
  EXPECT_STREQ(yars_client_error(), "yars_client_attach: expected an address as `client`, found NULL");
  const auto results = call_all(client_, nullptr);
  EXPECT_EQ(results.front(), 0) << "the heartbeat has no argument";
  for (const int result : std::span(results).subspan(1)) EXPECT_EQ(result, YARS_CLIENT_ARGUMENT);
  Records records;
  EXPECT_EQ(yars_client_read_frame(client_, 0, &records.frame, nullptr), YARS_CLIENT_ARGUMENT);
  EXPECT_EQ(yars_client_read_sweep(client_, nullptr, &records.sweep), YARS_CLIENT_ARGUMENT);
}

TEST_F(YarsClient, CodesTellTheCallersFaultFromTheWorlds) {
  yars_client* none = nullptr;
  EXPECT_EQ(yars_client_attach("../x", "tester", &none), YARS_CLIENT_ARGUMENT);
  EXPECT_EQ(yars_client_attach("no-such-session", "tester", &none), YARS_CLIENT_FAILED);
  const yars_nav nav{};
  EXPECT_EQ(yars_client_publish_nav(client_, &nav), YARS_CLIENT_ARGUMENT);
  EXPECT_STREQ(yars_client_error(),
               "yars_client_publish_nav: expected an ownship lane, found none; call yars_client_claim_ownship first");
}

TEST_F(YarsClient, TwoClientsAreTwoParticipants) {
  yars_client* const other = attached();
  EXPECT_EQ(session_.processes().size(), 3u);
  EXPECT_EQ(yars_client_claim_ownship(client_, 1), 0);
  EXPECT_EQ(yars_client_claim_ownship(other, 2), 1);
  EXPECT_EQ(yars_client_claim_input(client_, "one"), 0);
  EXPECT_EQ(yars_client_claim_input(other, "two"), 1);
  EXPECT_EQ(yars_client_claim_traffic(client_), 0);
  EXPECT_EQ(yars_client_claim_traffic(other), YARS_CLIENT_FAILED);
  const yars_ownship ownship{};
  EXPECT_EQ(yars_client_publish_ownship(client_, &ownship), 0);
  EXPECT_EQ(yars_client_publish_ownship(other, &ownship), 0);
  yars_client_detach(client_);
  EXPECT_FALSE(session_.layout().ownship[0].has_value()) << "withdrawn";
  EXPECT_TRUE(session_.layout().ownship[1].has_value());
  EXPECT_EQ(session_.processes().size(), 2u);
  yars_client_detach(other);
  EXPECT_EQ(session_.processes().size(), 1u);
}

TEST_F(YarsClient, ThreadsHaveClientsAndErrorsOfTheirOwn) {
  yars_client_publish_nav(nullptr, nullptr);
  const std::string of_this_thread = yars_client_error();
  std::vector<std::thread> threads;
  for (std::uint32_t i = 0; i < 3; ++i)
    threads.emplace_back([this, i] {
      EXPECT_STREQ(yars_client_error(), "");
      for (int round = 0; round < 20; ++round) {
        yars_client* const mine = attached();
        EXPECT_GE(yars_client_claim_ownship(mine, i), 0) << yars_client_error();
        yars_ownship ownship{};
        ownship.epoch = yars_client_epoch(mine);
        EXPECT_EQ(yars_client_publish_ownship(mine, &ownship), 0);
        yars_client_detach(mine);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(yars_client_error(), of_this_thread);
  EXPECT_EQ(session_.processes().size(), 2u);
}

TEST_F(YarsClient, AFullProcessTableIsNoError) {
  std::vector<yars_client*> many;
  for (std::size_t i = 0; i <= kProcesses; ++i) many.push_back(attached());
  EXPECT_EQ(yars_client_heartbeat(many.back()), 0) << yars_client_error();
  EXPECT_EQ(session_.processes().size(), kProcesses);
  for (yars_client* one : many) yars_client_detach(one);
}

TEST_F(YarsClient, ASessionWithoutItsNameIsJoined) {
  ASSERT_EQ(unlink(path().c_str()), 0);
  yars_client* const late = attached();
  EXPECT_EQ(yars_client_claim_ownship(late, 1), 0);
  EXPECT_TRUE(session_.ownship_lane_is_held(0));
  yars_client_detach(late);
}

TEST_F(YarsClient, AHeartbeatRestoresTheEntryInTheProcessTable) {
  session_.layout().processes[1].pid = 0;
  EXPECT_EQ(session_.processes().size(), 1u);
  EXPECT_EQ(yars_client_heartbeat(client_), 0);
  ASSERT_EQ(session_.processes().size(), 2u);
  EXPECT_EQ(session_.processes()[1].name, "tester");
}

TEST_F(YarsClient, ADamagedClockIsRefusedAndTheLastValidOneStays) {
  ClockState clock = session_.clock();
  clock.running = 0;
  clock.base_sim_ns = 5'000'000;
  clock.epoch = 7;
  ASSERT_TRUE(test::set_clock(session_, clock));
  EXPECT_EQ(yars_client_sim_time_ns(client_), 5'000'000);
  const auto expect_refused = [&](const std::function<void(ClockState&)>& damage) {
    ClockState damaged = clock;
    damaged.running = 1;
    damaged.epoch = 99;
    damage(damaged);
    session_.layout().clock.publish(damaged);
    EXPECT_EQ(yars_client_sim_time_ns(client_), 5'000'000);
    EXPECT_EQ(yars_client_epoch(client_), 7u);
  };
  expect_refused([](ClockState& c) { c.rate = std::numeric_limits<double>::quiet_NaN(); });
  expect_refused([](ClockState& c) { c.rate = 1e300; });
  expect_refused([](ClockState& c) { c.base_sim_ns = std::numeric_limits<std::int64_t>::min(); });
  expect_refused([](ClockState& c) { c.base_monotonic_ns = std::numeric_limits<std::int64_t>::max(); });
  session_.layout().clock.clear();
  EXPECT_EQ(yars_client_sim_time_ns(client_), 5'000'000) << "no clock";
}

TEST_F(YarsClient, ADamagedSlotCostsOneSweep) {
  Sweep sweep{};
  for (sweep.number = 0; sweep.number < 4; ++sweep.number) {
    sweep.samples = 100;
    session_.layout().sweeps.publish(sweep);
  }
  using Ring = decltype(SessionLayout::sweeps);
  auto* const ring = reinterpret_cast<unsigned char*>(&session_.layout().sweeps) + Ring::slots_offset();
  const auto word = [&](std::size_t slot, std::size_t n) -> std::uint64_t& {
    return *reinterpret_cast<std::uint64_t*>(ring + slot * Ring::slot_stride() + 8 * n);
  };
  word(0, 0) += 2;    // sequence
  word(1, 1) = 9999;  // used words: more than a sweep has
  word(2, 1) = 20;    // used words: fewer than its samples need
  yars_client_cursor cursor{};
  yars_sweep found{};
  ASSERT_EQ(yars_client_read_sweep(client_, &cursor, &found), 1);
  EXPECT_EQ(found.number, 3u);
  EXPECT_EQ(cursor.lost, 3u);
  EXPECT_EQ(yars_client_read_sweep(client_, &cursor, &found), 0);
  cursor.next = std::numeric_limits<std::uint64_t>::max();  // a caller's own damage
  EXPECT_EQ(yars_client_read_sweep(client_, &cursor, &found), 0);
}

// Whatever is in the segment, a client returns, and what it returns stays within the limits that its header states.
TEST_F(YarsClient, AnyBytesInTheSegmentAreSurvived) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  auto* const words = reinterpret_cast<std::uint64_t*>(&session_.layout());
  const auto damage = [&](std::size_t at, std::size_t bytes) {
    for (std::size_t i = at / 8; i < (at + bytes) / 8; ++i) words[i] = random() >> (random() % 64);
  };
  using Ring = decltype(SessionLayout::sweeps);
  Records records;
  for (int round = 0; round < 30; ++round) {
    damage(sizeof(shm::SegmentHeader),
           offsetof(SessionLayout, outputs) + sizeof(SessionLayout::outputs) - sizeof(shm::SegmentHeader));
    damage(offsetof(SessionLayout, input), 256);
    damage(offsetof(SessionLayout, sweeps), 8);
    for (std::size_t slot = 0; slot < Ring::kDepth; slot += 1 + random() % 100)
      damage(offsetof(SessionLayout, sweeps) + Ring::slots_offset() + slot * Ring::slot_stride(), 160);
    for (std::size_t slot = 0; slot < kFrameSlots; ++slot) {
      damage(offsetof(SessionLayout, frames) + slot * sizeof(FrameSlot), 72);
      session_.layout().frames[slot].id = random() % 8;
    }
    for (const int result : call_all(client_, &records)) EXPECT_GE(result, YARS_CLIENT_ARGUMENT);
    EXPECT_LE(records.frame.width, kMaxFramePixels);
    EXPECT_LE(records.frame.height, kMaxFramePixels);
    EXPECT_LE(records.sweep.samples, radar::kMaxSamples);
    EXPECT_GE(yars_client_sim_time_ns(client_), 0);
  }
}

}  // namespace
}  // namespace yars::databuffer
