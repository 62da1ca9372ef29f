// Branch of a recording: the point at which a live set takes over from the recording, and the items up to that point.
// Inputs: a recording; a time [s] of its session clock. Outputs: the records from which the roles resume; a copy of the
// items up to the point, each with the same bytes.
// A point is the tick of a recorded model status, because a radar model resumes from a status alone. Statuses are
// recorded every 0.1 s, in a live session up to 0.15 s apart.
// Errors: a time outside the recording (usage error); no ticks; no status or no radar state near the time.
// Threads: one call at a time for each reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/error/error.hpp"
#include "radar/recording/recorded_kinds.hpp"
#include "radar/recording/recording_io.hpp"

namespace yars::recording {

// First and last tick of a recording. nullopt: it has no ModelTick.
struct TickRange {
  std::int64_t first, last;
};
std::optional<TickRange> tick_range(const RecordingReader& reader);

// Tick of a time [s] in the recording. Errors: no ticks; a time outside the recording, as a usage error of `option`.
// `file`: name of the recording, for messages.
error::Expected<std::int64_t> tick_at(const RecordingReader& reader, double seconds, const std::string& file,
                                      const std::string& option);

struct BranchPoint {
  std::int64_t tick = 0;        // the last tick of the recording that belongs to the branch
  std::uint32_t epoch = 0;      // epoch of that tick
  std::size_t first_block = 0;  // all items of the blocks before it belong to the branch
  databuffer::RadarState state{};
  databuffer::ModelStatus status{};  // its tick is `tick`
  std::optional<databuffer::Outputs> outputs;
  std::optional<databuffer::Traffic> traffic;
  std::optional<databuffer::WorldState> world;  // in effect at the point; nullopt: the configuration's world
  std::string flight_source;                    // source of flight-model (FlightSource); empty: not recorded
};

// Newest point at or before the tick; if there is none, the first point after the tick. The newest point whose radar
// state has applied all events up to it is preferred, if it is at most 0.3 s earlier. Changes the reader's position.
error::Expected<BranchPoint> find_branch_point(RecordingReader& reader, std::int64_t tick, const std::string& file);

// Appends all items up to the point to a new recording. Blocks that belong to the branch as a whole are copied without
// decoding. Damaged blocks are left out. Errors: a failed write.
error::Expected<void> copy_until(RecordingReader& reader, const BranchPoint& point, RecordingWriter& writer);

}  // namespace yars::recording
