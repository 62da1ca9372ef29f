#include "tests/endtoend/lockstep_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "lib/imageio/png.hpp"
#include "tests/lib/imageio/read_png.hpp"

namespace yars::endtoend {

using nlohmann::json;

std::size_t lit_pixels(const std::filesystem::path& path) {
  const auto image = test::read_png(path);
  EXPECT_TRUE(image.has_value()) << path;
  std::size_t lit = 0;
  for (std::size_t i = 1; image && i < image->pixels.size(); i += static_cast<std::size_t>(image->channels))
    lit += image->pixels[i] > 60 ? 1 : 0;
  return lit;
}

namespace {

constexpr int kFrameEvery_s = 2;
constexpr double kTimeout_s = 240.0;
constexpr std::array kRoles{"flight-model", "input-monitor", "state-machine",
                            "radar-model",  "radar-display", "recorder"};

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Writes the script. Result: sim time that the set has to run for it [s].
int write_script(const std::filesystem::path& path, const std::vector<ScriptedStep>& steps) {
  constexpr double kFirst_s = 1.0, kSpare_s = 3.0;  // [s] time of the first step; time after the last one
  std::ofstream script(path);
  double time_s = kFirst_s;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i > 0) time_s += steps[i].after_s;
    script << time_s << " " << steps[i].event << "\n";
  }
  return static_cast<int>(std::ceil(time_s + kSpare_s));
}

}  // namespace

LockstepRun::LockstepRun(const std::string& name, const std::vector<ScriptedStep>& steps, const std::string& source,
                         const Place& place)
    : set_(name), recording_(set_.folder() / "run.yars") {
  const int seconds = write_script(set_.folder() / "script", steps);
  start("script:" + (set_.folder() / "script").string(), seconds, source, place);
  wait();
}

LockstepRun::LockstepRun(const std::string& name, const std::string& input, int seconds, const std::string& source,
                         const Place& place, const std::function<void(const ProcessSet&)>& meanwhile)
    : set_(name), recording_(set_.folder() / "run.yars") {
  start(input, seconds, source, place);
  eventually(
      [&] {
        meanwhile(set_);
        return std::ranges::none_of(kRoles, [this](const char* role) { return set_.runs(role); });
      },
      kTimeout_s);
  wait();
}

void LockstepRun::start(const std::string& input, int seconds, const std::string& source, const Place& place) {
  const std::string plan =
      "flight-model,input-monitor,state-machine,radar-model,radar-display,recorder@" + std::to_string(seconds * 200);
  std::filesystem::create_directories(frames());
  const auto start_role = [&](const std::string& role, std::vector<std::string> arguments) {
    if (!place.configuration.empty()) arguments.insert(arguments.begin() + 1, {"--config", place.configuration});
    arguments.insert(arguments.end(), {"--lockstep", plan});
    set_.start(role, arguments);
  };
  const std::vector<std::string> terrain =
      place.terrain.empty() ? std::vector<std::string>{} : std::vector<std::string>{"--terrain", place.terrain};
  std::vector<std::string> recorder{"yars", "record", "--patches", recording_.string()}, model{"radar-model"};
  recorder.insert(recorder.end(), terrain.begin(), terrain.end());
  model.insert(model.end(), terrain.begin(), terrain.end());
  start_role("recorder", recorder);
  start_role("flight-model", {"flight-model", "--source", source});
  start_role("input-monitor", {"input-monitor", "--source", input});
  start_role("state-machine", {"state-machine"});
  start_role("radar-model", model);
  start_role("radar-display",
             {"radar-display", "--headless", "--frames", frames().string(), "--every", std::to_string(kFrameEvery_s)});
}

void LockstepRun::wait() {
  for (const char* role : kRoles) EXPECT_EQ(set_.wait(role, kTimeout_s), 0) << role << ": " << set_.log_of(role);
}

std::filesystem::path LockstepRun::frame(int time_s) const {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%06d.png", time_s / kFrameEvery_s);
  return frames() / name.data();
}

std::map<std::string, std::string> LockstepRun::frame_bytes() const {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : std::filesystem::directory_iterator(frames()))
    bytes[entry.path().filename()] = bytes_of(entry.path());
  return bytes;
}

const std::vector<json>& LockstepRun::printed() const {
  if (!printed_.empty()) return printed_;
  const auto printed = set_.yars({"replay", "--print", recording_.string()});
  EXPECT_EQ(printed.code, 0) << printed.errors;
  std::istringstream lines(printed.output);
  for (std::string line; std::getline(lines, line);) printed_.push_back(json::parse(line));
  return printed_;
}

std::map<std::int64_t, json> LockstepRun::states() const {
  std::map<std::int64_t, json> states;
  for (const json& object : printed())
    if (object.contains("state")) states[object["tick"]] = object["state"];
  return states;
}

std::vector<Entry> LockstepRun::entries() const {
  const std::map<std::int64_t, json> all = states();
  std::vector<Entry> entries;
  for (const json& object : printed())
    if (object.contains("event")) entries.push_back({object["tick"], object["effective"], {}});
  for (auto& entry : entries) {
    auto state = all.upper_bound(entry.tick);
    if (state != all.begin()) entry.state = (--state)->second;
  }
  return entries;
}

json LockstepRun::replayed() const {
  const auto finished = set_.yars({"replay", "--events", recording_.string()}, 120.0);
  EXPECT_EQ(finished.code, 0) << finished.output << finished.errors;
  return json::parse(finished.output);
}

void expect_steps(const std::vector<Entry>& entries, const std::vector<ScriptedStep>& steps) {
  ASSERT_EQ(entries.size(), steps.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& step = steps[i];
    SCOPED_TRACE("step " + std::to_string(i) + ": " + step.event + " at tick " + std::to_string(entries[i].tick));
    EXPECT_EQ(entries[i].effective, step.effective);
    ASSERT_TRUE(entries[i].state.contains(step.field));
    EXPECT_EQ(entries[i].state[step.field], step.expected);
  }
}

}  // namespace yars::endtoend
