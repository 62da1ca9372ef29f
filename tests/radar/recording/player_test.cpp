// Player: at any tick of a recording, the display shows what it showed in the session. Each test runs with recorded
// video, and with sweeps that the kernel computes again.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "display/symbology/radar_video.hpp"
#include "radar/recording/replay.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/radar/recording/made_recording.hpp"
#include "world/world_values.hpp"

namespace yars::recording {
namespace {

using databuffer::ModelStatus;
using databuffer::RadarState;

constexpr int kStatusTicks = 20;  // interval of recorded model statuses, as of the recorder

// Records from which a display is drawn.
struct Seen {
  RadarState state{};
  ModelStatus status{};
  std::map<std::uint32_t, std::uint64_t> sweeps;  // hashes of sweeps of the current and the previous scan, by number
  std::vector<std::uint64_t> maps;                // ids
};

bool same_display(const Seen& a, const Seen& b) {
  return std::memcmp(&a.state, &b.state, sizeof a.state) == 0 &&
         std::memcmp(&a.status, &b.status, sizeof a.status) == 0 && a.sweeps == b.sweeps;
}

// Hashes of the sweeps of the two newest scans, by number.
std::map<std::uint32_t, std::uint64_t> picture_of(const std::vector<databuffer::Sweep>& sweeps) {
  std::map<std::uint32_t, std::uint64_t> picture;
  for (const databuffer::Sweep& sweep : sweeps)
    if (sweep.scan + 1 >= sweeps.back().scan) picture[sweep.number] = sweep.hash;
  return picture;
}

// A made-up session: the kernel runs, and the test changes range, freeze, maps and epoch. It collects the items that a
// recorder would write.
class Session {
 public:
  explicit Session(bool video) : video_(video), cockpit_(configuration_, model::terrain::built_in_hills()) {
    cockpit_.tick.resumed_tick = -1;
    cockpit_.tick.flags |= databuffer::kTickRestart;
    cockpit_.tick.samples = static_cast<std::uint32_t>(configuration_.fidelity.samples);
    state_.range_nm = 40.0;
    put(StateChange{state_});
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) step();
  }
  void change(double range_nm) {
    state_.range_nm = cockpit_.tick.command.range_nm = range_nm;
    ++cockpit_.tick.command.scan_restart;
    state_.tick = cockpit_.tick.tick;
    put(StateChange{state_});
  }
  void change_world(const databuffer::WorldState& world) {
    radar::WorldConfiguration next = configuration_.world;
    world::apply(world, next);
    cockpit_.kernel.use_world(next);
    put(world);
  }
  void freeze(bool on) { cockpit_.set_flag(databuffer::kFreeze, on); }
  void make_map(std::uint64_t id) {
    std::mt19937_64 random(id);
    Patch patch = test::patch_at(cockpit_.tick.tick, 8, random);
    patch.map.id = id;
    put(patch);
    state_.map_old = state_.map_newest;
    state_.map_newest = id;
    put(StateChange{state_});
  }
  // The recorder pauses for `ticks` ticks.
  void pause(int ticks) {
    const bool wrote = std::exchange(writing_, false);
    run(ticks);
    writing_ = wrote;
    put(StartingPoint{status()});
    put(StateChange{state_});
  }
  void begin_epoch() {
    ++cockpit_.tick.epoch;
    cockpit_.tick.tick = 0;
  }
  Seen seen() const { return {state_, status(), picture_of(sweeps_), {}}; }
  std::int64_t tick() const { return cockpit_.tick.tick; }
  void write(const std::filesystem::path& path) const {
    auto writer = RecordingWriter::create(path, {}, Existing::overwritten);
    ASSERT_TRUE(writer);
    for (const RecordingItem& item : items_)
      std::visit([&](const auto& record) { EXPECT_TRUE(writer->append(record)); }, item);
    ASSERT_TRUE(writer->close());
  }
  const radar::RadarConfiguration& configuration() const { return configuration_; }

 private:
  ModelStatus status() const {
    ModelStatus status = cockpit_.status();
    status.tick = cockpit_.tick.tick;
    status.sim_time_ns = cockpit_.tick.sim_time_ns;
    status.epoch = cockpit_.tick.epoch;
    status.ownship = cockpit_.tick.ownship;
    return status;
  }
  void step() {
    cockpit_.tick.ownship.latitude_deg += 1e-6;
    const bool has_sweep = cockpit_.step() != nullptr;
    put(cockpit_.tick);
    cockpit_.tick.flags &= ~databuffer::kTickRestart;
    if (cockpit_.tick.tick % kStatusTicks == 0) put(StatusReport{status()});
    if (!has_sweep) return;
    if (video_)
      put(cockpit_.sweep);
    else
      put(digest_of(cockpit_.sweep));
    if ((cockpit_.sweep.flags & databuffer::kSweepBlank) == 0) sweeps_.push_back(cockpit_.sweep);
  }
  template <class T>
  void put(const T& record) {
    if (writing_) items_.emplace_back(record);
  }

  bool video_;
  bool writing_ = true;
  radar::RadarConfiguration configuration_;
  test::Cockpit cockpit_;
  RadarState state_{};
  std::vector<databuffer::Sweep> sweeps_;
  std::vector<RecordingItem> items_;
};

// A display that is fed by the player.
class Display {
 public:
  void jump(const Played& played) {
    seen_ = {};
    sweeps_.clear();
    take(played);
  }
  void take(const Played& played) {
    if (played.state) seen_.state = *played.state;
    if (played.status) seen_.status = *played.status;
    sweeps_.insert(sweeps_.end(), played.sweeps.begin(), played.sweeps.end());
    for (const Patch& patch : played.maps) seen_.maps.push_back(patch.map.id);
    if (!sweeps_.empty()) seen_.sweeps = picture_of(sweeps_);
  }
  const Seen& seen() const { return seen_; }
  const std::vector<databuffer::Sweep>& sweeps() const { return sweeps_; }

 private:
  Seen seen_;
  std::vector<databuffer::Sweep> sweeps_;
};

class RecordingPlayed : public ::testing::TestWithParam<bool> {
 protected:
  RecordingPlayed() : session(GetParam()) {}

  void open() {
    session.write(file.path());
    auto opened = RecordingReader::open(file.path());
    ASSERT_TRUE(opened);
    reader.emplace(std::move(*opened));
    start();
  }
  void start() {
    std::optional<PlayerWorld> world;
    EXPECT_EQ(Player::has_video(*reader), GetParam());
    if (!GetParam())
      world = PlayerWorld{std::make_shared<radar::RadarConfiguration>(session.configuration()), &store, nullptr};
    player.emplace(*reader, std::move(world));
  }

  test::TemporaryFile file;
  Session session;
  model::terrain::FixedTerrainStore store{
      std::make_shared<const model::terrain::AnalyticTerrain>(model::terrain::built_in_hills())};
  std::optional<RecordingReader> reader;
  std::optional<Player> player;
  Display radar_display;
};

INSTANTIATE_TEST_SUITE_P(ByVideoAndByKernel, RecordingPlayed, ::testing::Values(true, false),
                         [](const auto& one) { return one.param ? "Video" : "Kernel"; });

// The picture is frozen for 3 minutes, with YARS_TEST_FULL for 12, so that its sweeps lie far before the tick of the
// seek.
TEST_P(RecordingPlayed, ASeekBringsAPictureFrozenForMinutes) {
  session.run(2000);
  session.freeze(true);
  session.run(std::getenv("YARS_TEST_FULL") != nullptr ? 144'000 : 36'000);
  const Seen expected = session.seen();
  const std::int64_t frozen = session.tick();
  session.freeze(false);
  session.run(400);
  open();
  radar_display.jump(player->seek(frozen));
  EXPECT_GT(radar_display.seen().sweeps.size(), 100U);
  EXPECT_EQ(radar_display.seen().sweeps, expected.sweeps);
}

TEST_P(RecordingPlayed, AtThreeTicksTheDisplayShowsWhatItShowedInTheSession) {
  std::map<std::int64_t, Seen> run;
  for (const double range_nm : {20.0, 40.0, 80.0}) {
    session.change(range_nm);
    session.run(2000);
    run[session.tick()] = session.seen();
    session.run(140);
  }
  open();
  // Seeks backwards and forwards, one tick twice.
  for (const std::int64_t tick :
       {run.rbegin()->first, run.begin()->first, std::next(run.begin())->first, run.rbegin()->first}) {
    SCOPED_TRACE(tick);
    radar_display.jump(player->seek(tick));
    EXPECT_GT(radar_display.seen().sweeps.size(), 100U);
    EXPECT_TRUE(same_display(radar_display.seen(), run.at(tick)));
    EXPECT_EQ(player->tick(), tick);
  }
  // Play from the beginning, tick by tick.
  radar_display.jump(player->seek(1));
  for (std::int64_t tick = 2; tick <= run.begin()->first; ++tick) radar_display.take(player->play_to(tick));
  EXPECT_TRUE(same_display(radar_display.seen(), run.begin()->second));
  EXPECT_EQ(player->different(), 0U);
}

// A world of the edit `edit` with one rain cell over the scanned area.
databuffer::WorldState rain_of(std::uint64_t edit, double rate_mmh) {
  radar::WorldConfiguration world;
  world.rain.cells = {{{37.25, -121.7}, 30'000.0, rate_mmh, 6000.0}};
  databuffer::WorldState state = world::world_state_from(world);
  state.flags = {};
  state.edit = edit;
  return state;
}

TEST_P(RecordingPlayed, ASeekRestoresTheWorldInEffectAtItsTick) {
  std::map<std::uint64_t, std::pair<std::int64_t, Seen>> run;  // by edit
  for (const std::uint64_t edit : {1U, 2U, 3U}) {
    session.change_world(rain_of(edit, 40.0 * static_cast<double>(edit)));
    session.run(2500);
    run[edit] = {session.tick(), session.seen()};
    session.run(1);  // a record without a tick of its own is played with the one before it
  }
  EXPECT_NE(run[1].second.sweeps, run[2].second.sweeps);
  open();
  for (const std::uint64_t edit : {2U, 1U, 3U}) {
    SCOPED_TRACE(edit);
    const Played played = player->seek(run[edit].first);
    ASSERT_TRUE(played.world);
    EXPECT_EQ(played.world->edit, edit);
    radar_display.jump(played);
    EXPECT_GT(radar_display.seen().sweeps.size(), 100U);
    EXPECT_EQ(radar_display.seen().sweeps, run[edit].second.sweeps);
    EXPECT_EQ(player->different(), 0U);
  }
}

// The change lies between the tick of a seek and a later tick.
TEST_P(RecordingPlayed, PlaysAChangeOfTheWorldAtItsTick) {
  session.run(1200);
  const std::int64_t before = session.tick();
  session.run(100);
  session.change_world(rain_of(7, 60.0));
  session.run(900);
  open();
  const Played sought = player->seek(before);
  EXPECT_FALSE(sought.world);
  radar_display.jump(sought);
  const Played played = player->play_to(session.tick());
  ASSERT_TRUE(played.world);
  EXPECT_EQ(played.world->edit, 7U);
  radar_display.take(played);
  EXPECT_EQ(radar_display.seen().sweeps, session.seen().sweeps);
  EXPECT_EQ(player->different(), 0U);
}

TEST_P(RecordingPlayed, ASeekBringsAllSweepsThatTheDisplayKeeps) {
  session.run(3001);
  const std::int64_t tick = session.tick();
  session.run(500);
  open();
  display::PolarStore sought, played;
  for (const auto& sweep : player->seek(tick).sweeps) sought.insert(sweep);
  for (const auto& sweep : player->seek(1).sweeps) played.insert(sweep);
  for (const auto& sweep : player->play_to(tick).sweeps) played.insert(sweep);
  ASSERT_GT(played.by_azimuth().size(), 100U);
  EXPECT_EQ(sought.by_azimuth().size(), played.by_azimuth().size());
  EXPECT_EQ(sought.newest()->range_m, played.newest()->range_m);
}

TEST_P(RecordingPlayed, PlayAfterASeekEndsWithThePictureOfTheSession) {
  session.run(2500);
  open();
  radar_display.jump(player->seek(1000));
  radar_display.take(player->play_to(2400));
  const auto end = player->play_to(1'000'000);
  EXPECT_TRUE(end.ended);
  EXPECT_EQ(player->tick(), 2500);
  radar_display.take(end);
  EXPECT_TRUE(radar_display.seen().sweeps == session.seen().sweeps);
}

TEST_P(RecordingPlayed, TheAircraftMovesWithEveryTickThoughStatusesAreTwentyTicksApart) {
  session.run(100);
  open();
  radar_display.jump(player->seek(41));
  const double before_deg = radar_display.seen().status.ownship.latitude_deg;
  radar_display.take(player->play_to(42));
  EXPECT_GT(radar_display.seen().status.ownship.latitude_deg, before_deg);
}

TEST_P(RecordingPlayed, AFileThatWasCutPlaysToItsLastWholeBlockAndEnds) {
  session.run(2000);
  session.write(file.path());
  const std::string bytes = file.bytes();
  auto cut = RecordingReader::read(std::make_unique<std::istringstream>(bytes.substr(0, bytes.size() * 2 / 3)), "cut");
  ASSERT_TRUE(cut);
  reader.emplace(std::move(*cut));
  start();
  radar_display.jump(player->seek(1));
  const Played end = player->play_to(1'000'000);
  EXPECT_TRUE(end.ended);
  EXPECT_TRUE(reader->cut_short());
  EXPECT_GT(player->tick(), 500);
  EXPECT_LT(player->tick(), 1900);
  EXPECT_FALSE(end.sweeps.empty());
}

TEST_P(RecordingPlayed, ADamagedBlockIsSkippedAndTheRestPlays) {
  session.run(2000);
  session.write(file.path());
  std::string bytes = file.bytes();
  const auto blocks = test::blocks_of(bytes);
  ASSERT_GE(blocks.size(), 6U);
  const std::int64_t lost_from = blocks[3].first_tick, lost_to = blocks[3].last_tick;
  bytes[blocks[3].offset + 100] ^= 1;
  auto damaged = RecordingReader::read(std::make_unique<std::istringstream>(bytes), "damaged");
  ASSERT_TRUE(damaged);
  reader.emplace(std::move(*damaged));
  start();
  radar_display.jump(player->seek(1));
  radar_display.take(player->play_to(lost_from));
  const Played end = player->play_to(1'000'000);
  EXPECT_TRUE(end.ended);
  EXPECT_EQ(player->tick(), 2000);
  EXPECT_FALSE(end.sweeps.empty()) << "sweeps continue after the damaged block";
  EXPECT_EQ(player->different(), 0U) << "they equal the recorded sweeps";
  ASSERT_EQ(reader->missing().size(), 1U);
  EXPECT_EQ(reader->missing()[0].first_tick, lost_from);
  EXPECT_EQ(reader->missing()[0].last_tick, lost_to);
}

// The recording jumps by 1e12 ticks, which are 158 years of sim time, and to both ends of the range of ticks.
TEST(RecordingPlayer, JumpsOfTicksAreCutsAndPlayReachesTheEnd) {
  constexpr auto kGreatest = std::numeric_limits<std::int64_t>::max();
  std::vector<RecordingItem> items;
  for (const std::int64_t tick : {std::int64_t{1}, std::int64_t{2}, std::int64_t{1'000'000'000'000}, std::int64_t{3},
                                  kGreatest, -kGreatest, std::int64_t{5}}) {
    databuffer::ModelTick record = test::tick_at(0);
    record.tick = tick;
    items.emplace_back(record);
  }
  auto reader = test::reader_of(test::recorded(items));
  ASSERT_TRUE(reader);
  Player player(*reader, std::nullopt);
  Played played = player.seek(1);
  int cuts = 0;
  for (int call = 0; call < 100 && !played.ended; ++call) {
    played = player.play_to(played.cut_to_tick ? *played.cut_to_tick : player.tick() + 1);
    cuts += played.cut_to_tick ? 1 : 0;
  }
  EXPECT_TRUE(played.ended);
  EXPECT_GE(cuts, 4);
}

TEST_P(RecordingPlayed, APauseOfTheRecorderIsACut) {
  session.run(1500);
  const std::int64_t stopped = session.tick();
  session.pause(5000);
  const std::int64_t begun = session.tick();
  session.run(1500);
  const Seen last = session.seen();
  open();
  radar_display.jump(player->seek(stopped - 100));
  const Played before = player->play_to(begun);
  EXPECT_EQ(before.cut_to_tick, begun);
  EXPECT_EQ(player->tick(), stopped);
  EXPECT_FALSE(before.ended);
  radar_display.jump(player->play_to(begun + 1500));
  EXPECT_EQ(player->tick(), begun + 1500);
  EXPECT_TRUE(radar_display.seen().sweeps == last.sweeps);
  EXPECT_EQ(player->different(), 0U);
  // A seek into the pause leads to the last tick before it.
  radar_display.jump(player->seek(stopped + 1000));
  EXPECT_EQ(player->tick(), stopped);
}

TEST_P(RecordingPlayed, ANewEpochThatBeginsAtTickOneIsACut) {
  session.run(1500);
  session.begin_epoch();
  session.run(700);
  open();
  (void)player->seek(1400);
  const Played before = player->play_to(1'000'000);
  EXPECT_EQ(before.cut_to_tick, 1);
  EXPECT_EQ(player->tick(), 1500);
  const Played after = player->play_to(600);
  EXPECT_EQ(player->tick(), 600);
  ASSERT_TRUE(after.status);
  EXPECT_EQ(after.status->epoch, 2U);
}

TEST_P(RecordingPlayed, ASeekBringsTheMapsThatTheStateNames) {
  session.run(300);
  for (const std::uint64_t id : {1U, 2U, 3U}) {
    session.make_map(id);
    session.run(600);
  }
  open();
  radar_display.jump(player->seek(session.tick()));
  EXPECT_EQ(radar_display.seen().maps, (std::vector<std::uint64_t>{3, 2}));
  radar_display.jump(player->seek(800));
  EXPECT_EQ(radar_display.seen().maps, (std::vector<std::uint64_t>{1}));
  radar_display.take(player->play_to(1000));
  EXPECT_EQ(radar_display.seen().maps, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(radar_display.seen().state.map_newest, 2U);
}

}  // namespace
}  // namespace yars::recording
