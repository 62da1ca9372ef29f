// Long run of a set at ten times real time. Checks the rate of sim time, the flown position, the age of records,
// losses unless a program was kept from running, and the growth of memory, open files and threads. 20 s by default;
// YARS_ENDURANCE_SECONDS=3600 with YARS_ENDURANCE_TERRAIN=DIR runs for an hour. With an X display, radar-display opens
// a window. Prints measurements.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>
#include <thread>

#include "databuffer/session/session.hpp"
#include "flightmodel/source_reader.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/modes.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {
namespace {

constexpr double kRate = 10.0;            // times real time
constexpr double kPollInterval_s = 0.25;  // [s] wall time between measurements
constexpr double kWarmUp = 0.25;          // fraction of the run before resources must stay constant
constexpr double kMaxAge_s = 0.5;         // [s] sim time by which the last record may be behind the clock
constexpr std::size_t kLastAges = 20;     // On a loaded machine the least of the last ages counts.
// [s] wall time: half of the time for which the ring of sweeps holds what a program has not read yet. A program that
// does not run for longer, because the machine is overloaded, may lose sweeps, and reports it.
constexpr double kMaxStall_s = 0.5 * 5.0 / kRate;
constexpr double kMaxOffset_m =
    50;  // [m] from the expected position; flight-model may replace skipped ticks by one longer step
#ifdef __SANITIZE_ADDRESS__
constexpr long kMemoryGrowth_kB = 512 * 1024;  // the sanitizer keeps up to 256 MB of freed memory
#else
constexpr long kMemoryGrowth_kB = 8192;
#endif

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

double run_time_s() {
  const std::string text = setting("YARS_ENDURANCE_SECONDS");
  return text.empty() ? 20.0 : std::stod(text);
}

struct Resources {
  long resident_kB = 0;
  long files = 0;
  long threads = 0;
};

Resources resources_of(pid_t pid) {
  Resources found;
  const auto folder = std::filesystem::path("/proc") / std::to_string(pid);
  std::ifstream status(folder / "status");
  for (std::string word; status >> word;) {
    if (word == "VmRSS:") status >> found.resident_kB;
    if (word == "Threads:") status >> found.threads;
  }
  // A frame or a folder may be open for a moment, so the fewest open files of several readings count.
  using Folder = std::filesystem::directory_iterator;
  constexpr int kReadings = 5;
  for (int reading = 0; reading < kReadings; ++reading) {
    const long files = std::distance(Folder(folder / "fd"), Folder());
    found.files = reading == 0 ? files : std::min(found.files, files);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return found;
}

// The flight that the set's flight-model flies, computed here tick by tick.
class ExpectedFlight {
 public:
  explicit ExpectedFlight(const std::string& source) : source_(flightmodel::open_source(source)) {}
  // Distance [m] of `seen` from the expected position at `tick`. `tick` must not decrease from call to call.
  double distance_m(std::int64_t tick, const databuffer::Ownship& seen) {
    const auto one_tick = geo::Duration::seconds(radar::kTickSeconds);
    for (; tick_ < tick; ++tick_) source_->model->step(one_tick);
    const auto own = source_->model->step({}).ownship;
    return geo::geodesic_inverse({own.latitude_deg, own.longitude_deg}, {seen.latitude_deg, seen.longitude_deg})
        .distance.metres();
  }

 private:
  error::Expected<flightmodel::FlightSource> source_;
  std::int64_t tick_ = 0;
};

struct Role {
  std::string name;
  Resources warm{};  // at the end of the warm-up; memory: the maximum until then
  Resources last{};
  long most_kB = 0;  // maximum of resident memory
};

class Endurance : public ::testing::Test {
 protected:
  Endurance() : set_("endurance") {}

  // The configured terrain, else a plain at sea level.
  std::string terrain() {
    if (const std::string given = setting("YARS_ENDURANCE_TERRAIN"); !given.empty()) return given;
    const auto folder = set_.folder() / "terrain";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "N37W123.hgt") << "";
    std::filesystem::resize_file(folder / "N37W123.hgt", std::size_t{1201} * 1201 * 2);
    return folder.string();
  }

  void start() {
    set_.start("state-machine", {"state-machine"});
    set_.start("radar-model", {"radar-model", "--terrain", terrain()});
    set_.start("flight-model", {"flight-model", "--source", source_});
    set_.start("recorder", {"yars", "record", (set_.folder() / "recording").string()});
    std::vector<std::string> radar_display{"radar-display"};
    if (std::string(setting("DISPLAY")).empty())
      radar_display.insert(radar_display.end(),
                           {"--headless", "--frames", (set_.folder() / "frames").string(), "--every", "10"});
    set_.start("radar-display", radar_display);
    for (const auto* name : {"state-machine", "radar-model", "flight-model", "recorder", "radar-display"})
      roles_.push_back({.name = name});
    ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() >= 5; }));
    ASSERT_EQ(set_.yars({"inject", "power opr"}).code, 0);
    ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["sweeps"] > 50; })) << set_.watch().dump();
    ASSERT_EQ(set_.yars({"sim", "rate", "10"}).code, 0);
    ASSERT_EQ(set_.yars({"sim", "reset"}).code, 0);
    auto session = databuffer::Session::open_read_only(set_.session());
    ASSERT_TRUE(session) << session.error().message();
    session_.emplace(std::move(*session));
  }

  // Injects a random event of a pilot. The fixed seed gives the same events in each run.
  void press_something() {
    static constexpr std::array kPresses{"pb 13", "pb 14", "pb 9", "elevation -2", "elevation -4", "pb 3", "pb 4"};
    const auto* press = kPresses[std::uniform_int_distribution<std::size_t>(0, kPresses.size() - 1)(random_)];
    EXPECT_EQ(set_.yars({"inject", press}).code, 0) << press;
  }

  void measure_roles(bool warm) {
    for (Role& role : roles_) {
      role.last = resources_of(set_.pid(role.name));
      role.most_kB = std::max(role.most_kB, role.last.resident_kB);
      if (!warm)
        role.warm = {std::max(role.warm.resident_kB, role.last.resident_kB), role.last.files, role.last.threads};
    }
  }

  // Compares sim time and position with their expected values, and keeps the greatest differences.
  void measure_flight(ExpectedFlight& flight) {
    databuffer::ModelStatus model{};
    const auto& layout = std::as_const(*session_).layout();
    const auto clock = session_->clock();
    const auto now_ns = databuffer::monotonic_ns();
    if (!layout.model_status.read(model) || model.epoch != clock.epoch || model.ownship.epoch != clock.epoch) return;
    if (!first_) first_ = Moment{.wall_ns = now_ns, .sim_ns = databuffer::sim_time_at(clock, now_ns)};
    const double wall_s = 1e-9 * static_cast<double>(now_ns - first_->wall_ns);
    const double sim_s = 1e-9 * static_cast<double>(databuffer::sim_time_at(clock, now_ns) - first_->sim_ns);
    clock_drift_s_ = std::max(clock_drift_s_, std::abs(sim_s - kRate * wall_s));
    const auto age_ns = databuffer::sim_time_at(clock, now_ns) - model.ownship.source_time_ns;
    last_ages_s_[age_ % kLastAges] = 1e-9 * static_cast<double>(age_ns);
    most_age_s_ = std::max(most_age_s_, last_ages_s_[age_++ % kLastAges]);
    const auto tick = std::llround(1e-9 * static_cast<double>(model.ownship.source_time_ns) / radar::kTickSeconds);
    const double off_m = flight.distance_m(tick, model.ownship);
    if (!first_off_m_) first_off_m_ = off_m;
    most_off_m_ = std::max(most_off_m_, off_m);
    late_ticks_ = model.late_ticks;
    sweeps_ = model.sweeps;
    for (const auto& process : session_->processes())
      stall_s_ = std::max(stall_s_, 1e-9 * static_cast<double>(now_ns - process.heartbeat_ns));
  }

  std::uint64_t losses() const {
    return session_->layout().note_counts[static_cast<std::size_t>(databuffer::NoteKind::loss)].load();
  }

  void print(double wall_s) const {
    std::cout << std::fixed << "after " << wall_s << " s at " << kRate << " times real time: " << sweeps_
              << " sweeps, losses " << losses() << ", late ticks " << late_ticks_
              << "; sim time off its rate by at most " << clock_drift_s_ << " s; records behind by at most "
              << most_age_s_ << " s; longest stall " << stall_s_ << " s; position off by " << first_off_m_.value_or(0.0)
              << " m at first, at most " << most_off_m_ << " m\n";
    for (const Role& role : roles_)
      std::cout << "  " << role.name << ": " << role.warm.resident_kB << " kB warm, " << role.last.resident_kB
                << " kB now, most " << role.most_kB << " kB; files " << role.warm.files << " -> " << role.last.files
                << "; threads " << role.warm.threads << " -> " << role.last.threads << "\n";
    std::cout << std::flush;
  }

  struct Moment {
    std::int64_t wall_ns;
    std::int64_t sim_ns;
  };

  ProcessSet set_;
  std::string source_ = "route:" YARS_SOURCE_DIR "/config/routes/california.route";
  std::vector<Role> roles_;
  std::optional<databuffer::Session> session_;
  std::mt19937 random_{20261122};
  std::optional<Moment> first_;
  std::optional<double> first_off_m_;
  double clock_drift_s_ = 0.0;
  double most_age_s_ = 0.0;  // [s] sim time by which ownship records were behind the clock
  std::array<double, kLastAges> last_ages_s_{};
  std::size_t age_ = 0;  // number of measured ages
  double most_off_m_ = 0.0;
  double stall_s_ = 0.0;  // [s] wall time for which a program did not run, at most
  std::uint64_t late_ticks_ = 0;
  std::uint64_t sweeps_ = 0;
};

TEST_F(Endurance, AtTenTimesRealTimeNothingGrowsNothingIsLostAndNothingDrifts) {
  ASSERT_NO_FATAL_FAILURE(start());
  ExpectedFlight flight(source_);
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  const double all_s = run_time_s();
  double next_press_s = 2.0;
  double next_print_s = 60.0;
  for (double wall_s = 0.0; wall_s < all_s; wall_s = std::chrono::duration<double>(Clock::now() - began).count()) {
    usleep(static_cast<useconds_t>(kPollInterval_s * 1e6));
    measure_flight(flight);
    measure_roles(wall_s > kWarmUp * all_s);
    if (wall_s >= next_press_s) press_something(), next_press_s += 2.0;
    if (wall_s >= next_print_s) print(wall_s), next_print_s += 60.0;
  }
  print(all_s);
  ASSERT_TRUE(first_off_m_) << "no model status of the flight was read: " << set_.watch().dump();
  EXPECT_GT(sweeps_, static_cast<std::uint64_t>(all_s)) << "the radar scanned";
  if (stall_s_ < kMaxStall_s) {
    EXPECT_EQ(losses(), 0U) << set_.yars({"status"}).output;
  }
  EXPECT_LT(clock_drift_s_, 1e-6);
  ASSERT_GT(age_, kLastAges);
  EXPECT_LT(*std::min_element(last_ages_s_.begin(), last_ages_s_.end()), kMaxAge_s) << "the set falls behind";
  EXPECT_LT(most_off_m_, kMaxOffset_m);
  for (const Role& role : roles_) {
    SCOPED_TRACE(role.name);
    EXPECT_LE(role.last.resident_kB, role.warm.resident_kB + kMemoryGrowth_kB);
    EXPECT_EQ(role.last.files, role.warm.files);
    EXPECT_EQ(role.last.threads, role.warm.threads);
  }
  for (const auto& [role, code] : set_.end_all()) EXPECT_EQ(code, 0) << role << ": " << set_.log_of(role);
}

}  // namespace
}  // namespace yars::endtoend
