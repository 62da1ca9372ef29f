// Takes what a session's processes publish and appends it to a recording; a call takes what has come since the one
// before and never waits. It writes from the begin on; PB 12 stops it and starts it again, in the same file, from a new
// starting point. What it does stands in the session's RecorderStatus: about once a second, and at once when it
// changes. When the disk takes no more it looks for room every 5 s, and goes on as after a pause. What no
// role would believe, a text that could drive a terminal for instance, is not recorded, and noted.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "databuffer/session/session.hpp"
#include "tools/recording/recorded_kinds.hpp"
#include "tools/recording/recording_writer.hpp"

namespace yars::tools {

struct RecordedExtras {
  bool sweeps = false;           // with their video, instead of their hashes alone
  bool patches = false;          // with their pictures
  std::uint64_t keep_bytes = 0;  // of this file and the one before together; 0: no limit
};

class Recorder {
 public:
  // `from_the_begin`: also what was done before it came and is still in the rings; else from here on, with the model's
  // status as the starting point.
  Recorder(databuffer::Session& session, recording::RecordingWriter& writer, RecordedExtras extras,
           bool from_the_begin);

  // `tick`: of the session's clock.
  void drain(std::int64_t tick);
  // Puts on the disk what has been gathered.
  void flush();
  // An error: the disk takes no more just now; what came before it reads back.
  const error::Expected<void>& outcome() const { return outcome_; }
  std::uint64_t refused() const { return refused_; }  // records

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t sweeps() const { return sweeps_; }

 private:
  void begin_here();
  void obey(std::uint32_t vtr_request);
  void take_all(std::int64_t tick);
  void settle(error::Expected<void> written);
  void look_for_room();
  void begin_next_file();
  template <class T>
  bool believes(const T& record);
  void publish(std::int64_t tick);
  void take_ticks(std::uint64_t& lost);
  void take_traffic_before(const databuffer::ModelTick& tick);
  void take_sweeps(std::uint64_t& lost);
  void take_latest(std::int64_t tick);
  void take_patches();
  template <class T>
  void append(const T& record);

  databuffer::Session* session_;
  recording::RecordingWriter* writer_;
  RecordedExtras extras_;
  std::uint64_t tick_cursor_ = 0, event_cursor_ = 0, sweep_cursor_ = 0, traffic_cursor_ = 0;
  std::optional<std::int64_t> from_tick_;  // the first to write; none: all
  std::uint32_t from_epoch_ = 0;
  shm::LatestReader<databuffer::RadarState> state_;
  shm::LatestReader<databuffer::ModelStatus> status_;
  shm::LatestReader<databuffer::Outputs> outputs_;
  recording::StatePace state_pace_;
  recording::Pace status_pace_, outputs_pace_;
  databuffer::Sweep sweep_{};
  recording::Patch patch_;
  std::vector<std::uint64_t> patches_seen_;  // ids of those in the pool that were written
  std::uint64_t ticks_ = 0, sweeps_ = 0;
  bool writing_ = true;
  std::uint32_t vtr_request_ = 0;  // the last one obeyed
  databuffer::RecorderStatus published_{};
  bool has_published_ = false;
  error::Expected<void> outcome_;           // the error that lasts
  std::int64_t next_look_for_room_ns_ = 0;  // CLOCK_MONOTONIC
  bool resumes_writing_ = false;            // it wrote when the disk took no more
  std::uint64_t refused_ = 0;
};

}  // namespace yars::tools
