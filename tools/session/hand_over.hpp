// Hand-over of a recording to a live set (`yars replay --hand-over`): the set goes on from a recorded second.
// This process takes the roles state-machine and radar-model, freezes the clock behind the tick of the branch point,
// publishes the key frame of that tick, and gives the roles back. The live roles resume from the key frame as after a
// restart. When they have joined, this process runs the clock and ends.
// Inputs: a recording, the branch point, the roles that are awaited.
// Outputs: records in the segment; on standard output the line `claimed` when the session is prepared (state-machine
//   and radar-model may be started with --standby) and the line `ready` when both have done a tick (flight-model may be
//   started). A flight-model that is started earlier would begin at its start.
// Errors: another process has one of the two roles; the roles do not join within 30 s; a request to stop.
// Threads: main thread only.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "lib/error/error.hpp"
#include "radar/recording/branch.hpp"
#include "radar/recording/replay.hpp"

namespace yars::tools {

struct HandOverOptions {
  std::string session;
  std::string roles = "state-machine,radar-model,flight-model";  // awaited before the clock runs
  bool prints = true;                                            // the lines `claimed` and `ready`
};

// `open_world` is called after the line `claimed`: see recording::Player.
error::Expected<void> hand_over(recording::RecordingReader& reader, const recording::BranchPoint& point,
                                const std::function<std::optional<recording::PlayerWorld>()>& open_world,
                                const HandOverOptions& options);

}  // namespace yars::tools
