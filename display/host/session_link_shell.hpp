// What a display takes from its session each look, and what its pilot sends there.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "databuffer/runtime/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "display/gl/context.hpp"
#include "display/symbology/plan_view.hpp"

namespace yars::display {

// Keeps a DisplayInput and the glass's sweeps and maps up to date with the session, by copies; waits for nobody.
// A restarted glass reads the ring from its oldest sweep and the maps named by the radar state: it repaints at once,
// also when frozen.
class SessionFeed {
 public:
  using SweepSink = std::function<void(const databuffer::Sweep&)>;
  using MapSink = std::function<void(const databuffer::PatchMap&, std::span<const std::uint8_t>)>;
  // In lockstep a role counts as alive when it takes part: clocks of the wall must not show in a frame.
  SessionFeed(databuffer::Session& session, bool lockstep, SweepSink sweeps, MapSink maps);

  // Takes over what is new. Times are those of the moment or of the tick.
  void refresh(std::int64_t sim_time_ns);
  // What is in input() is on the glass: others can measure how long a button takes.
  void note_shown() { session_->show_progress(static_cast<std::uint32_t>(state_version_)); }
  const DisplayInput& input() const { return input_; }

 private:
  void take_sweeps();
  void take_state();
  void take_maps();
  void take_map(std::uint64_t id);
  void take_model(std::int64_t sim_time_ns);
  void take_status();
  void look_who_is_alive();

  databuffer::Session* session_;
  bool lockstep_;
  SweepSink sweep_sink_;
  MapSink map_sink_;
  databuffer::OwnshipReceiver receiver_;
  DisplayInput input_;
  databuffer::Sweep sweep_{};
  std::uint64_t sweep_cursor_ = 0;
  std::array<databuffer::PatchMap, 3> maps_{};  // NEW, OLD and STORE, in any order; id 0 = an empty place
  std::vector<std::uint8_t> pixels_;
  std::uint64_t refused_map_ = 0;  // told once
  std::uint64_t state_version_ = 0;
  std::uint64_t status_version_ = 0;
  bool has_status_ = false;
  std::int64_t next_look_ns_ = 0;  // CLOCK_MONOTONIC
};

// Clicks on the legends and keys typed on the glass, as events in an input lane of the session.
class PilotInput {
 public:
  // `source`: who sends, as `yars status` shows it.
  static error::Expected<PilotInput> create(databuffer::Session& session, std::string_view source);

  void press(int button);  // 1..20
  // The button whose legend lies under the click, if any, is pressed; false: none.
  bool click(Point at);
  void send(const gl::WindowInput& input);
  void release_all();  // what is held when the window goes away

 private:
  PilotInput(databuffer::Session& session, databuffer::Claim claim) : session_(&session), claim_(std::move(claim)) {}
  void push(databuffer::InputEvent event);

  databuffer::Session* session_;
  databuffer::Claim claim_;
  databuffer::KeyboardState keyboard_;
  std::uint32_t number_ = 0;
};

}  // namespace yars::display
