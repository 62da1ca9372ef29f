// Takes what a session's processes publish and appends it to a recording. It reads only; a call takes what has come
// since the one before and never waits.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/session.hpp"
#include "tools/recording/recording_writer.hpp"
#include "tools/recording/state_pace.hpp"

namespace yars::tools {

struct RecordedExtras {
  bool sweeps = false;   // with their video, instead of their hashes alone
  bool patches = false;  // with their pictures
};

class Recorder {
 public:
  // `from_the_begin`: also what was done before it came and is still in the rings; else from here on, with the model's
  // status as the starting point.
  Recorder(databuffer::Session& session, recording::RecordingWriter& writer, RecordedExtras extras,
           bool from_the_begin);

  // `tick`: of the session's clock. An error: the disk takes no more.
  failure::Expected<void> drain(std::int64_t tick);

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t sweeps() const { return sweeps_; }

 private:
  void begin_here();
  void take_ticks(std::uint64_t& lost);
  void take_sweeps(std::uint64_t& lost);
  void take_latest(std::int64_t tick);
  void take_patches();
  template <class T>
  void append(const T& record);

  databuffer::Session* session_;
  recording::RecordingWriter* writer_;
  RecordedExtras extras_;
  std::uint64_t tick_cursor_ = 0, event_cursor_ = 0, sweep_cursor_ = 0;
  std::optional<std::int64_t> from_tick_;  // the first to write; none: all
  std::uint32_t from_epoch_ = 0;
  shm::LatestReader<databuffer::RadarState> state_;
  shm::LatestReader<databuffer::ModelStatus> status_;
  shm::LatestReader<databuffer::Outputs> outputs_;
  recording::StatePace state_pace_;
  recording::Pace status_pace_, outputs_pace_;
  databuffer::Sweep sweep_{};
  recording::Patch patch_;
  std::uint64_t newest_patch_ = 0;  // id of the last one written
  std::uint64_t ticks_ = 0, sweeps_ = 0;
  failure::Expected<void> outcome_;  // the first error
};

}  // namespace yars::tools
