// `yars replay FILE`: plays a recording into a separate session, for a radar-display. The replay follows that session's
// clock, so `yars sim freeze`, `run`, `rate` and `step` control the replay. `yars sim reset` seeks in the recording.
#pragma once

#include <optional>
#include <string>

#include "lib/error/error.hpp"
#include "tools/recording/replay.hpp"

namespace yars::tools {

struct PlayOptions {
  std::string file;  // name for messages
  std::string session;
  double rate = 1.0;             // [0, 10] times real time; 0: the clock stands still
  std::optional<double> seek_s;  // [s] sim time at which to begin; nullopt: the start of the recording
  bool json = false;             // the result is printed as one JSON object
};

// Returns when the recording has ended or a stop was requested. `world`: see recording::Player. Errors: a rate that is
// not a number; a --seek time outside the recording; a session in lockstep; another process with the role state-machine
// or radar-model; a recorded tick beyond the clock's range.
error::Expected<void> play_recording(recording::RecordingReader& reader, std::optional<recording::PlayerWorld> world,
                                     const PlayOptions& options);

}  // namespace yars::tools
