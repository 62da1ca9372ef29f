// Recorder of a session: reads the records that the session's processes publish and appends them to a recording.
// Inputs: rings and latest values of the segment. A press of push button 12 (counted in RadarState::vtr_request) stops
// or starts writing. Each start writes the model's present status, if any, into the same file as a StartingPoint.
// Outputs: the recording; RecorderStatus about once a second and on each change.
// Errors: a write error, such as a full disk, stops writing. Every 5 s the recorder tries to start again. A file that
// was removed or renamed is noticed within 2 s, and a new one begins. A record that fails validation is left out and
// noted in the flight recorder. Threads: one. No call waits for another process.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/session/session.hpp"
#include "radar/recording/branch.hpp"
#include "radar/recording/recorded_kinds.hpp"
#include "radar/recording/recording_io.hpp"

namespace yars::tools {

struct RecordedExtras {
  bool sweeps = false;           // true: sweeps with video; false: only their hashes
  bool patches = false;          // true: patch maps with pixels; false: no patch maps
  std::string flight_source;     // --source of flight-model, recorded in each file; empty: unknown
  std::uint64_t keep_bytes = 0;  // [bytes] limit of the recording and its predecessor FILE.before together; 0: none
};

class Recorder {
 public:
  // `from_oldest`: if true, the records that are already in the rings are recorded too. If false, the recording begins
  // at this call. Its starting point is then the model's present status, if there is one.
  Recorder(databuffer::Session& session, recording::RecordingWriter& writer, RecordedExtras extras, bool from_oldest);

  // Continues a branch: records what the session has after the point, and no starting point. The items up to the point
  // are in the file already. The session must still hold all ticks since the point (holds_branch()).
  void continue_branch(const recording::BranchPoint& point);
  // True if the rings of the session have lost no record since the session began.
  static bool holds_branch(const databuffer::Session& session);
  // True if the session's first tick is, or will be, the one behind the point.
  static bool is_branch(const databuffer::Session& session, const recording::BranchPoint& point);

  // One poll: appends the new records of the rings, and the latest values at a limited rate. Also tries to write again
  // after a write error, begins the next file, applies presses of push button 12, and publishes RecorderStatus.
  // `tick`: current tick of the session's clock.
  void drain(std::int64_t tick);
  // Writes the buffered records to the file.
  void flush();
  // The write error that has stopped writing, if any. The records that were written before the error can be read.
  const error::Expected<void>& outcome() const { return outcome_; }
  std::uint64_t refused() const { return refused_; }  // number of records that failed validation

  // Numbers of recorded ticks and sweeps.
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t sweeps() const { return sweeps_; }

 private:
  void begin_here();
  void append_flight_source();
  void apply_vtr_request(std::uint32_t vtr_request);
  void take_all(std::int64_t tick);
  void handle_result(error::Expected<void> written);
  void retry_after_error();
  void begin_next_file();
  void check_place();
  template <class T>
  bool is_valid(const T& record);
  template <class T>
  bool is_in_branch(const T& record) const;
  void publish(std::int64_t tick);
  bool is_before_start(const databuffer::ModelTick& tick) const;
  void take_ticks(std::uint64_t& lost);
  void take_traffic_before(const databuffer::ModelTick& tick);
  void take_world_before(const databuffer::ModelTick& tick);
  void take_sweeps(std::uint64_t& lost);
  void take_latest(std::int64_t tick);
  void take_patches();
  template <class T>
  void append(const T& record);

  databuffer::Session* session_;
  recording::RecordingWriter* writer_;
  RecordedExtras extras_;
  std::uint64_t tick_cursor_ = 0, event_cursor_ = 0, sweep_cursor_ = 0, traffic_cursor_ = 0;
  std::optional<std::uint64_t> world_cursor_;  // nullopt: no tick was written since writing began
  std::optional<std::int64_t> from_tick_;      // earlier ticks of from_epoch_ are not written; nullopt: all are written
  std::uint32_t from_epoch_ = 0;
  std::optional<std::int64_t> branch_tick_;  // records up to this tick of branch_epoch_ are in the file already
  std::uint32_t branch_epoch_ = 0;
  std::uint64_t begin_cursor_ = 0;  // ticks before it were published before the starting point was read
  shm::LatestReader<databuffer::RadarState> state_;
  shm::LatestReader<databuffer::ModelStatus> status_;
  shm::LatestReader<databuffer::Outputs> outputs_;
  recording::StatePace state_pace_;
  recording::Pace status_pace_, outputs_pace_;
  databuffer::Sweep sweep_{};
  recording::Patch patch_;
  std::vector<std::uint64_t> patches_seen_;  // ids of maps in the pool that were already read
  std::uint64_t ticks_ = 0, sweeps_ = 0;
  bool writing_ = true;
  std::uint32_t vtr_request_ = 0;  // RadarState::vtr_request that was last applied
  databuffer::RecorderStatus published_{};
  bool has_published_ = false;
  std::uint64_t file_number_ = 0;   // RecordingWriter::files() when writing last began
  std::int64_t next_check_ns_ = 0;  // next check_place(), CLOCK_MONOTONIC
  error::Expected<void> outcome_;   // the write error that has stopped writing
  std::int64_t next_retry_ns_ = 0;  // earliest next attempt, CLOCK_MONOTONIC
  bool resumes_writing_ = false;    // whether writing starts again when the error is over
  std::uint64_t refused_ = 0;
};

}  // namespace yars::tools
