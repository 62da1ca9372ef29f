#include "tests/endtoend/fault_injection/fault_set.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>

namespace yars::endtoend::fault_injection {

namespace {

// Position of the flight. recover() repositions an aircraft that is more than kAway_deg away in latitude or longitude.
constexpr double kLatitude_deg = 37.4;
constexpr double kLongitude_deg = -122.6;
constexpr double kAway_deg = 0.4;
constexpr int kPosts = 1201;  // along one edge of an HGT cell

std::string bin(const std::string& name) {
  return std::string(YARS_BIN_DIR) + "/" + name;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Contents of an HGT cell: waves of 0 to 800 m, 16 bit big-endian, row by row from the north-west corner.
std::string waves() {
  std::string cell;
  cell.reserve(std::size_t{2} * kPosts * kPosts);
  for (int row = 0; row < kPosts; ++row)
    for (int column = 0; column < kPosts; ++column) {
      const int height_m = static_cast<int>(400.0 + 400.0 * std::sin(0.05 * row) * std::cos(0.03 * column));
      cell += static_cast<char>(height_m >> 8);
      cell += static_cast<char>(height_m & 0xff);
    }
  return cell;
}

std::string last_lines(const std::string& log) {
  constexpr std::size_t kMaxBytes = 1500;
  return log.size() <= kMaxBytes ? log : log.substr(log.size() - kMaxBytes);
}

}  // namespace

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

FaultSet::FaultSet(std::uint64_t seed)
    : set_("faults"),
      terrain_(set_.folder() / "terrain"),
      scene_(set_.folder() / "airfield.flt"),
      configuration_(set_.folder() / "set.guf"),
      script_(set_.folder() / "script"),
      chance_(seed) {
  write_files();
}

FaultSet::~FaultSet() = default;

void FaultSet::write_files() {
  std::filesystem::create_directories(terrain_);
  const std::string cell = waves();
  for (const auto* name : {"N37W123.hgt", "N37W124.hgt"}) write_text(terrain_ / name, cell);
  run_program({"yars", "scene", "generate", "--kind", "airfield", "--triangles", "2000", "--origin", "37.5,-122.5",
               "--out", scene_.string()});
  write_text(configuration_, "( Scenes `( ( Scene \"" + scene_.string() + "\" ) ) )\n");
  std::ostringstream script;
  for (int second = 1; second < 3600; ++second) script << second << " elevation " << -2.5 - 0.5 * (second % 3) << '\n';
  write_text(script_, script.str());
}

void FaultSet::start(const std::string& role) {
  std::vector<std::string> command{role, "--config", configuration_.string()};
  const auto add = [&command](std::initializer_list<std::string> more) {
    command.insert(command.end(), more.begin(), more.end());
  };
  if (role == "radar-model") add({"--terrain", terrain_.string(), "--samples", "256"});
  if (role == "flight-model") add({"--source", "fixed:37.4,-122.6,15000,20,250"});
  if (role == "radar-display") add({"--headless", "--publish", "--size", "160"});
  if (role == "input-monitor") add({"--source", "script:" + script_.string()});
  if (role == "recorder") {
    command.front() = "yars";
    add({"record", "--overwrite", (set_.folder() / "recording").string()});
  }
  set_.start(role, command);
}

void FaultSet::start_all() {
  for (const auto& role : kRoles) start(role);
  watch_ = std::make_unique<Watch>(set_.session());
}

void FaultSet::kill(const std::string& role) {
  killed_.insert(role);
  set_.kill(role, SIGKILL);
  eventually([&] { return !set_.runs(role); }, 20.0);
}

void FaultSet::mend() {
  for (const auto& role : kRoles) {
    if (set_.runs(role)) continue;
    const int code = set_.start_again(role);
    ++restarts_;
    const bool ordered = killed_.erase(role) > 0 && code == 128 + SIGKILL;
    const bool allowed = may_fail_.contains(role) && code == 1;
    if (!ordered && !allowed)
      tell(role + " ended by itself with code " + std::to_string(code) + ": " + last_lines(set_.log_of(role)));
  }
}

bool FaultSet::is_away() const {
  return std::abs(watch_->latitude_deg() - kLatitude_deg) > kAway_deg ||
         std::abs(watch_->longitude_deg() - kLongitude_deg) > kAway_deg;
}

double FaultSet::recover(double timeout_s) {
  const auto begin = std::chrono::steady_clock::now();
  const std::uint64_t sweeps = watch_->sweeps();
  const std::uint64_t frames = watch_->frames();
  constexpr std::uint64_t kSweeps = 5;
  constexpr std::uint64_t kFrames = 2;
  constexpr double kRetry_s = 0.5;
  const std::uint32_t first_mark = ++mark_;
  const auto is_well = [&] {
    return std::ranges::all_of(kRoles, [this](const auto& role) { return set_.runs(role); }) &&
           watch_->sweeps() >= sweeps + kSweeps && watch_->frames() >= frames + kFrames &&
           watch_->newest_mark() >= first_mark && watch_->flies() && !is_away();
  };
  while (seconds_since(begin) < timeout_s) {
    mend();
    other({"fault_client", "restore", set_.session(), std::to_string(mark_)});
    if (watch_->flies() && is_away()) set_.yars({"sim", "reposition", "37.4", "-122.6", "15000", "20"});
    if (eventually(is_well, kRetry_s)) {
      may_fail_.clear();
      return seconds_since(begin);
    }
    ++mark_;
  }
  return -1.0;
}

std::string FaultSet::signs_of_life() const {
  std::ostringstream text;
  text << watch_->sweeps() << " sweeps, " << watch_->frames() << " pictures, " << watch_->events() << " events, mark "
       << watch_->newest_mark() << " of " << mark_ << (watch_->flies() ? ", flies at " : ", stale at ")
       << watch_->latitude_deg() << ' ' << watch_->longitude_deg() << '\n'
       << set_.yars({"status"}).output;
  return text.str();
}

std::string FaultSet::client(const std::string& mode, double number) {
  const std::string name = "client";
  set_.start_tool(name, {bin("fault_client"), mode, set_.session(), std::to_string(number),
                         std::to_string(chance_() % 1'000'000'000)});
  return name;
}

void FaultSet::end_client(const std::string& name) {
  set_.kill(name, SIGKILL);
  const int code = set_.wait(name);
  if (code != 128 + SIGKILL && code != 1)
    tell("a client ended with code " + std::to_string(code) + ": " + last_lines(set_.log_of(name)));
}

Finished FaultSet::other(const std::vector<std::string>& command) const {
  return run_program(command, 60.0);
}

double FaultSet::between(double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(chance_);
}

std::size_t FaultSet::below(std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(chance_);
}

void FaultSet::rest_ms(double least, double most) {
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(between(least, most)));
}

std::map<std::string, Held> FaultSet::held() const {
  std::map<std::string, Held> all;
  for (const auto& role : kRoles) {
    const std::filesystem::path process = "/proc/" + std::to_string(set_.pid(role));
    Held held;
    std::error_code gone;
    for (auto it = std::filesystem::directory_iterator(process / "fd", gone); it != end(it); it.increment(gone))
      ++held.handles;
    for (auto it = std::filesystem::directory_iterator(process / "task", gone); it != end(it); it.increment(gone))
      ++held.threads;
    std::size_t virtual_pages = 0;
    std::size_t resident = 0;
    std::ifstream(process / "statm") >> virtual_pages >> resident;
    held.memory_mib = static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
    all[role] = held;
  }
  return all;
}

}  // namespace yars::endtoend::fault_injection
