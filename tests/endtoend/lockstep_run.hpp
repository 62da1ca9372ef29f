// Runs a whole set in lockstep with a script of events and a recorder. Returns the state after each event, the frames
// and the replay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {

// An event of the script, whether it does something there, and one field of the state after it
// (docs/spec/pilots_interface.md#controls).
struct ScriptedStep {
  std::string event;
  bool effective = false;
  std::string field;
  nlohmann::json expected;
  double after_s = 0.25;  // the step before
};

struct Entry {
  std::int64_t tick = 0;
  bool effective = false;
  nlohmann::json state;  // in force at the end of that tick
};

// Where a set flies; empty: the built-in hills, the built-in radar.
struct Place {
  std::string terrain;        // a folder
  std::string configuration;  // a file
};

class LockstepRun {
 public:
  LockstepRun(const std::string& name, const std::vector<ScriptedStep>& steps, const std::string& source,
              const Place& place = {});

  const std::filesystem::path& recording() const { return recording_; }
  std::filesystem::path frames() const { return set_.folder() / "frames"; }
  // The picture of a whole, even second of sim time.
  std::filesystem::path frame(int time_s) const;
  bool segment_exists() const { return set_.segment_exists(); }
  std::map<std::string, std::string> frame_bytes() const;
  // The script's events in order, each with the state at the end of its tick.
  std::vector<Entry> entries() const;
  // The states that came and went, by tick.
  std::map<std::int64_t, nlohmann::json> states() const;
  nlohmann::json replayed() const;
  // What `yars replay --print` says, an object a line.
  std::vector<nlohmann::json> printed() const;

 private:
  ProcessSet set_;
  std::filesystem::path recording_;
};

// Checks each entry against its step.
void expect_steps(const std::vector<Entry>& entries, const std::vector<ScriptedStep>& steps);

// Pixels of a frame that are lit well.
std::size_t lit_pixels(const std::filesystem::path& path);

}  // namespace yars::endtoend
