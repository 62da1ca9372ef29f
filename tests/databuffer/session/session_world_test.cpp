// Changes of a session's world: each builds on the newest one, and several programs at once lose none.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/session_changes.hpp"
#include "tests/databuffer/session/open_session.hpp"
#include "tests/world/new_entries.hpp"
#include "world/world_values.hpp"

namespace yars::databuffer {
namespace {

class SessionWorldTest : public testing::OpenSessionTest {
 protected:
  // A radar-model that has published its configuration's world.
  void start_model() {
    auto claim = model_.claim(Role::radar_model);
    ASSERT_TRUE(claim);
    role_ = std::move(*claim);
    radar::WorldConfiguration world;
    world.sea.state = 2.0;
    const WorldState configured = world::world_state_from(world);
    model_.layout().world_configured.publish(configured);
    model_.layout().world_latched.publish(configured);
  }
  void latch() {
    WorldState wanted{};
    ASSERT_TRUE(model_.layout().world.read(wanted));
    model_.layout().world_latched.publish(wanted);
  }
  static error::Expected<WorldState> set_sea(Session& session, double state) {
    return change_world(session, [state](const WorldState& before) -> error::Expected<WorldState> {
      WorldState next = before;
      if (auto done = world::set_sea_state(next, state); !done) return tl::unexpected(done.error());
      return next;
    });
  }
  static error::Expected<WorldState> add_rain(Session& session) {
    return change_world(session, [](const WorldState& before) -> error::Expected<WorldState> {
      WorldState next = before;
      if (auto id = world::add(next, world::new_rain_cell({0.0, 0.0})); !id) return tl::unexpected(id.error());
      return next;
    });
  }

  Session model_ = open("radar-model");
  Claim role_;
};

TEST_F(SessionWorldTest, WithoutARadarModelAChangeIsRefused) {
  const auto refused = set_sea(model_, 3.0);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("radar-model"), std::string::npos) << refused.error().message();
  EXPECT_FALSE(newest_world(model_.layout()));
}

TEST_F(SessionWorldTest, AChangeBuildsOnTheOneThatIsNotLatchedYet) {
  start_model();
  ASSERT_TRUE(set_sea(model_, 5.0));
  const auto second = add_rain(model_);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->edit, 2U);
  EXPECT_EQ(second->sea_state, 5.0);
  EXPECT_EQ(second->rain_count, 1U);
  EXPECT_EQ(world_in_effect(model_.layout())->edit, 0U);
  EXPECT_EQ(newest_world(model_.layout())->edit, 2U);
  latch();
  EXPECT_EQ(world_in_effect(model_.layout())->edit, 2U);
}

TEST_F(SessionWorldTest, ARefusedChangeLeavesTheWorldAsItIs) {
  start_model();
  EXPECT_FALSE(set_sea(model_, 9.0));
  EXPECT_FALSE(change_world(model_, [](WorldState world) -> error::Expected<WorldState> {
    world.wind_speed_mps = -1.0;
    return world;
  }));
  EXPECT_FALSE(model_.layout().world.has_value());
  EXPECT_FALSE(model_.role_is_held(Role::instructor));
}

TEST_F(SessionWorldTest, AResetGivesTheConfigurationsWorldAlsoBeforeItIsLatched) {
  start_model();
  ASSERT_TRUE(set_sea(model_, 5.0));
  latch();
  const auto reset = change_world(model_, reset_of(model_));
  ASSERT_TRUE(reset);
  EXPECT_EQ(reset->edit, 2U);
  EXPECT_EQ(reset->sea_state, 2.0);
  EXPECT_NE(reset->flags & kWorldConfigured, 0U);
  EXPECT_EQ(add_rain(model_)->sea_state, 2.0);
  latch();
  const std::uint32_t id = world_in_effect(model_.layout())->rain[0].id;
  ASSERT_TRUE(change_world(model_, reset_of(model_)));
  EXPECT_GT(add_rain(model_)->rain[0].id, id) << "a reset gives no id again";
}

// A replay publishes recorded worlds, and nobody latches a change.
TEST_F(SessionWorldTest, InTheSessionOfAReplayAChangeIsRefused) {
  start_model();
  model_.layout().world_configured.clear();
  const auto refused = set_sea(model_, 3.0);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("replay"), std::string::npos) << refused.error().message();
}

// ---- radar-model on another host
class WorldOfAnotherHost : public SessionWorldTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(start_model());
    model_.layout().network.mirrored_roles = 1U << static_cast<unsigned>(Role::radar_model);
  }
  // Acts as the gateway: waits for a request and answers it. `newest`: world that the other host has then.
  WorldState answer(WorldAnswer answer, std::optional<WorldState> newest = std::nullopt) {
    SessionLayout& layout = model_.layout();
    auto& requests = layout.world_requests;
    while (requests.asked == requests.answered >> 8) std::this_thread::yield();
    WorldState request{};
    EXPECT_TRUE(layout.world_request.read(request));
    if (newest) layout.world.publish(*newest);
    requests.answered = requests.asked << 8 | static_cast<std::uint64_t>(answer);
    return request;
  }
  // change(session), while gateway() acts as the gateway.
  template <class Change, class Gateway>
  error::Expected<WorldState> changed(const Change& change, const Gateway& gateway) {
    std::optional<error::Expected<WorldState>> result;
    std::thread editor([&] {
      Session session = open("editor");
      result = change(session);
    });
    gateway();
    editor.join();
    return *result;
  }
};

TEST_F(WorldOfAnotherHost, IsChangedByARequest) {
  const auto done = changed([](Session& session) { return set_sea(session, 3.0); },
                            [this] {
                              const WorldState request = answer(WorldAnswer::applied);
                              EXPECT_EQ(request.edit, 1U);
                              EXPECT_EQ(request.sea_state, 3.0);
                            });
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(done->edit, 1U);
  EXPECT_FALSE(model_.layout().world.has_value()) << "only the gateway writes it";
}

TEST_F(WorldOfAnotherHost, KeepsTheEditThatCameFirstThere) {
  WorldState theirs = *newest_world(model_.layout());
  theirs.edit = 1;
  theirs.flags = {};
  theirs.sea_state = 6.0;
  const auto done = changed([](Session& session) { return add_rain(session); },
                            [&] {
                              EXPECT_EQ(answer(WorldAnswer::outdated, theirs).edit, 1U);
                              const WorldState again = answer(WorldAnswer::applied);
                              EXPECT_EQ(again.edit, 2U);
                              EXPECT_EQ(again.sea_state, 6.0);
                              EXPECT_EQ(again.rain_count, 1U);
                            });
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(done->sea_state, 6.0);
}

TEST_F(WorldOfAnotherHost, IsNotChangedWithoutItsConsent) {
  const auto message_of = [this](WorldAnswer word) {
    const auto refused = changed([](Session& session) { return set_sea(session, 3.0); }, [&] { answer(word); });
    return refused ? "changed" : refused.error().message();
  };
  EXPECT_NE(message_of(WorldAnswer::refused).find("refusals"), std::string::npos);
  EXPECT_NE(message_of(WorldAnswer::forbidden).find("topicsOut"), std::string::npos);
  EXPECT_NE(message_of(WorldAnswer::late).find("none in time"), std::string::npos);
}

TEST_F(WorldOfAnotherHost, IsNotAwaitedForEver) {
  const auto refused = set_sea(model_, 3.0);  // nobody answers
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("none in time"), std::string::npos) << refused.error().message();
  EXPECT_FALSE(model_.role_is_held(Role::instructor));
}

TEST_F(WorldOfAnotherHost, IsChangedWithoutWaiting) {
  WorldChangeInProgress change(model_, [](WorldState world) -> error::Expected<WorldState> {
    world.sea_state = 4.0;
    return world;
  });
  EXPECT_FALSE(change.poll()) << "asked";
  EXPECT_FALSE(change.poll()) << "not answered yet";
  EXPECT_TRUE(model_.role_is_held(Role::instructor));
  EXPECT_EQ(answer(WorldAnswer::applied).sea_state, 4.0);
  const auto done = change.poll();
  ASSERT_TRUE(done && *done);
  EXPECT_EQ((*done)->sea_state, 4.0);
  EXPECT_EQ(model_.layout().world_requests.asked, 1U);
}

TEST_F(SessionWorldTest, AChangeWaitsForAnotherEditorAndGivesUpAfterAWhile) {
  start_model();
  auto other = open("other editor");
  auto claim = other.claim(Role::instructor);
  ASSERT_TRUE(claim);
  WorldChangeInProgress change(model_, reset_of(model_));
  EXPECT_FALSE(change.poll());
  *claim = Claim();
  const auto done = change.poll();
  ASSERT_TRUE(done && *done);
  auto again = other.claim(Role::instructor);
  ASSERT_FALSE(again) << "held until the change in progress is gone";
}

TEST_F(WorldOfAnotherHost, IsNotAskedForWhatIsOutOfRange) {
  EXPECT_FALSE(set_sea(model_, 9.0));
  EXPECT_EQ(model_.layout().world_requests.asked, 0U);
}

TEST_F(SessionWorldTest, ADamagedWishIsNoWorld) {
  start_model();
  WorldState damaged{};
  damaged.edit = 7;
  damaged.wind_speed_mps = -1.0;
  model_.layout().world.publish(damaged);
  EXPECT_EQ(newest_world(model_.layout())->edit, 0U);
  EXPECT_EQ(set_sea(model_, 3.0)->edit, 1U);
}

TEST_F(SessionWorldTest, SeveralEditorsAtOnceLoseNoEdit) {
  start_model();
  constexpr int kEditors = 4, kEdits = 10;
  std::vector<std::thread> editors;
  for (int i = 0; i < kEditors; ++i)
    editors.emplace_back([this] {
      Session session = open("editor");
      for (int edit = 0; edit < kEdits; ++edit) {
        while (!add_rain(session)) std::this_thread::yield();  // another editor may hold the role for long
      }
    });
  for (std::thread& editor : editors) editor.join();
  const auto world = newest_world(model_.layout());
  ASSERT_TRUE(world);
  EXPECT_EQ(world->edit, static_cast<std::uint64_t>(kEditors * kEdits));
  EXPECT_EQ(world->rain_count, static_cast<std::uint32_t>(kEditors * kEdits));
  EXPECT_EQ(validate(*world), std::nullopt);
}

}  // namespace
}  // namespace yars::databuffer
