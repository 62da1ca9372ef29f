// `yars replay FILE`: plays a recording into a session of its own, for a glass. It follows the session's clock: `yars
// sim freeze`, `run`, `rate` and `step` hold it, let it go on, change its pace; `yars sim reset` begins again.
#pragma once

#include <optional>
#include <string>

#include "lib/error/error.hpp"
#include "tools/recording/replay.hpp"

namespace yars::tools {

struct PlayOptions {
  std::string file;  // for messages
  std::string session;
  double rate = 1.0;             // [0, 10] times real time; 0 holds the picture
  std::optional<double> seek_s;  // [s] sim time; none: the begin
};

// Until the recording ends, or a stop is asked for. `world`: see Player.
error::Expected<void> play_recording(recording::RecordingReader& reader, std::optional<recording::PlayerWorld> world,
                                     const PlayOptions& options);

}  // namespace yars::tools
