// A run of the whole set in lockstep with a script of events and a recorder. Results: the state after each event, the
// frames of the display, the recording and its replay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {

// An event of the script (docs/pilots_manual.md#controls), and the expected value of one field of the state
// after it.
struct ScriptedStep {
  std::string event;
  bool effective = false;  // expected: the event has an effect
  std::string field;
  nlohmann::json expected;
  double after_s = 0.25;  // [s] sim time since the step before
};

// A recorded event.
struct Entry {
  std::int64_t tick = 0;
  bool effective = false;
  nlohmann::json state;  // at the end of that tick
};

struct Place {
  std::string terrain;        // folder; empty: the built-in hills
  std::string configuration;  // file; empty: the built-in radar
};

class LockstepRun {
 public:
  LockstepRun(const std::string& name, const std::vector<ScriptedStep>& steps, const std::string& source,
              const Place& place = {});
  // `input`: source of input-monitor, such as "tour:FILE". `meanwhile` is called again and again while the set runs.
  LockstepRun(const std::string& name, const std::string& input, int seconds, const std::string& source,
              const Place& place, const std::function<void(const ProcessSet&)>& meanwhile);

  const std::filesystem::path& recording() const { return recording_; }
  std::filesystem::path frames() const { return set_.folder() / "frames"; }
  // File of the frame at `time_s`, an even number of seconds of sim time.
  std::filesystem::path frame(int time_s) const;
  bool segment_exists() const { return set_.segment_exists(); }
  std::map<std::string, std::string> frame_bytes() const;
  // The script's events in order, each with the state at the end of its tick.
  std::vector<Entry> entries() const;
  // All states that were recorded, by the tick from which each applies.
  std::map<std::int64_t, nlohmann::json> states() const;
  nlohmann::json replayed() const;  // output of `yars replay --events`
  // Output of `yars replay --print`, one object per line; read once.
  const std::vector<nlohmann::json>& printed() const;

 private:
  void start(const std::string& input, int seconds, const std::string& source, const Place& place);
  void wait();

  ProcessSet set_;
  std::filesystem::path recording_;
  mutable std::vector<nlohmann::json> printed_;
};

// Expects that the recorded events have the effects of the steps.
void expect_steps(const std::vector<Entry>& entries, const std::vector<ScriptedStep>& steps);

// Number of pixels of a frame with a green channel above 60 of 255.
std::size_t lit_pixels(const std::filesystem::path& path);

}  // namespace yars::endtoend
