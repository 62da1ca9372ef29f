// Fixture: a set that scripts/start supervises, over a plain at sea level. Helpers read the log of scripts/start and
// the status of the set.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {

inline constexpr double kTimeout_s = 60.0;

inline std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

class Supervision : public ::testing::Test {
 protected:
  Supervision() : set_("supervised"), terrain_(set_.folder() / "terrain"), logs_(set_.folder() / "logs") {
    // A plain at sea level: a cell of zeros.
    std::filesystem::create_directories(terrain_);
    std::ofstream(terrain_ / "N37W123.hgt") << "";
    std::filesystem::resize_file(terrain_ / "N37W123.hgt", std::size_t{1201} * 1201 * 2);
  }
  ~Supervision() override {
    if (set_.runs("start")) end();
    // If the supervisor was killed after the timeout, its roles still run.
    const auto left = set_.watch();
    if (left.is_null()) return;
    for (const auto& process : left["processes"]) ::kill(process["pid"].get<int>(), SIGKILL);
  }

  // `more`: further arguments of scripts/start. `before`: a command in front of it, such as "nice".
  void start(const std::vector<std::string>& more = {}, const std::string& source = "fixed:37.5,-122.9,15000,90,480",
             const std::vector<std::string>& before = {}) {
    // No leak check here: it sometimes crashes beside Mesa's threads. Tests that start single roles check for leaks.
    std::vector<std::string> command = before;
    command.insert(command.end(),
                   {"env", "ASAN_OPTIONS=detect_leaks=0", std::string(YARS_SOURCE_DIR) + "/scripts/start", "--bin",
                    YARS_BIN_DIR, "--session", set_.session(), "--terrain", terrain_.string(), "--config",
                    std::string(YARS_SOURCE_DIR) + "/config/default.guf", "--source", source, "--frames",
                    (set_.folder() / "frames").string(), "--log-dir", logs_.string(), "--size", "240"});
    if (std::ranges::find(more, "--headless") == more.end()) command.insert(command.end(), {"--headless", "1000"});
    command.insert(command.end(), more.begin(), more.end());
    set_.start_tool("start", command);
  }
  void start_and_wait(const std::vector<std::string>& more = {}) {
    start(more);
    ASSERT_TRUE(set_.wait_until(
        [](const auto& watch) {
          return watch["processes"].size() >= 4 && watch["power"] == "OPR" && watch["sweeps"] > 50;
        },
        kTimeout_s))
        << set_.watch().dump() << start_log();
  }

  std::string start_log() const { return set_.log_of("start"); }
  nlohmann::json status() const { return set_.status(); }
  std::string reasons() const {
    const auto now = status();
    return now.is_null() ? "no session" : now["health"]["reasons"].dump();
  }
  std::vector<std::string> faults() const { return faults_in(status()); }
  int pid_of(const std::string& role) const {
    const auto processes = set_.watch()["processes"];
    return processes.contains(role) ? processes[role]["pid"].get<int>() : 0;
  }
  void kill_and_wait_for_the_next(const std::string& role) {
    const int before = pid_of(role);
    ASSERT_GT(before, 0) << role << start_log();
    ::kill(before, SIGKILL);
    ASSERT_TRUE(set_.wait_until(
        [&](const auto& watch) {
          return watch["processes"].contains(role) && watch["processes"][role]["pid"] != before;
        },
        kTimeout_s))
        << role << start_log();
  }
  int end() {
    set_.kill("start", SIGTERM);
    return set_.wait("start");
  }

  ProcessSet set_;
  std::filesystem::path terrain_;
  std::filesystem::path logs_;
};

}  // namespace yars::endtoend
