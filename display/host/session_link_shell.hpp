// Link between a display and its session: copies of records for the display, pilot inputs as events.
// Inputs: radar state, model status, ownship, sweeps, patch maps of the session; clicks, keys.
// Outputs: DisplayInput; sweeps and maps, passed to two callbacks (sinks); input events in an input lane.
// Errors: invalid records are dropped and noted in the flight recorder; the last valid record stays in use.
// Threads: one thread. No call waits for another program.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "display/gl/context.hpp"
#include "display/symbology/plan_view.hpp"
#include "runtime/claims.hpp"

namespace yars::display {

// Reader of the session for a display. A new reader starts at the oldest sweep of the ring and the maps of the radar
// state, so that a restarted display repaints immediately, even while no new sweep comes.
class SessionFeed {
 public:
  using SweepSink = std::function<void(const databuffer::Sweep&)>;
  using MapSink = std::function<void(const databuffer::PatchMap&, std::span<const std::uint8_t>)>;
  // In a live session a program counts as alive if its heartbeat is less than 1 s old. In a lockstep session it counts
  // as alive if it takes part in the run, because frames must be repeatable.
  SessionFeed(databuffer::Session& session, bool lockstep, SweepSink sweeps, MapSink maps);

  // Copies all new records. `sim_time_ns`: the present simulation time, or the time of the tick in lockstep.
  void refresh(std::int64_t sim_time_ns);
  // Publishes the version of the radar state that is visible, for measurements of button latency.
  void note_shown() { session_->publish_progress(static_cast<std::uint32_t>(state_.version())); }
  const DisplayInput& input() const { return input_; }

 private:
  void take_sweeps();
  void take_state();
  void take_maps();
  void take_model(std::int64_t sim_time_ns);
  void take_status();
  void take_advice();
  void take_health();
  void take_caption();
  void take_ranging();

  databuffer::Session* session_;
  bool lockstep_;
  SweepSink sweep_sink_;
  MapSink map_sink_;
  databuffer::OwnshipReceiver receiver_;
  DisplayInput input_;
  databuffer::Sweep sweep_{};
  std::uint64_t sweep_cursor_ = 0;
  std::array<databuffer::PatchMap, 3> maps_{};  // newest, old and stored map, in any order; id 0: free entry
  std::vector<std::uint8_t> pixels_;
  databuffer::WantedMaps wanted_maps_{*session_, "display: patch map"};
  databuffer::Validated<databuffer::RadarState> state_;
  databuffer::Validated<databuffer::ModelStatus> status_;
  databuffer::Validated<databuffer::Caption> caption_;
  bool tour_runs_ = false;  // a process holds the role `tour`; always true in lockstep
  databuffer::Validated<databuffer::PilotAdvice> advice_;
  databuffer::Validated<databuffer::Outputs> outputs_;
  std::int64_t next_health_ns_ = 0;  // CLOCK_MONOTONIC time of the next reading of the process table
};

// Writer of pilot inputs: clicks on legends and typed keys become events in an input lane of the session.
class PilotInput {
 public:
  // `source`: name of the sender in `yars status`. Error: no input lane is free.
  static error::Expected<PilotInput> create(databuffer::Session& session, std::string_view source);

  void press(int button);  // 1..20
  // Presses the button whose click zone contains `at`. Returns false if `at` is in no click zone.
  bool click(Point at);
  void send(const databuffer::InputEvent& event) { lane_.send(event); }  // stamps the event with time and number
  void send_key(const gl::KeyEdge& edge);
  void release_all();  // releases all held keys; called when the window loses focus or closes

 private:
  explicit PilotInput(runtime::InputLane lane) : lane_(std::move(lane)) {}

  runtime::InputLane lane_;
  databuffer::KeyboardState keyboard_;
};

}  // namespace yars::display
