// Sources of input events: the interface, a group of sources, and scripts played by simulation time. Lines of a script,
// whose syntax tours share: their times, and the last line `end`.
// Inputs: the time of each call (Moment); text of a script; `#` begins a comment.
// Outputs: input events without time stamps and sequence numbers; InputMonitorShell adds these. Each line with its
// time, in order; the time of `end`.
// Units: nanoseconds, in scripts of sim time; waits in milliseconds.
// Errors: of a script: file name and line, what was expected, what was found.
// Threads: all calls of a source come from one thread; a source starts no thread. No source reads a clock.
#pragma once

#include <poll.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/messages/caption.hpp"
#include "databuffer/messages/input_event.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// One line without its time.
struct ScriptLine {
  std::int64_t time_ns = 0;
  std::string_view what;  // the words after the time
  std::string location;   // file name and line number, for errors
};

struct ScriptTimes {
  std::optional<std::int64_t> end_ns;  // time of `end`; nullopt: there is no such line
  bool from_start = false;             // true: times count from the start of the script; false: simulation times
};

// Line:  TIME_S WHAT | +DT_S WHAT | [TIME_S] end
//   TIME_S     simulation time [s], not before the time of the line above
//   +DT_S      interval after the time of the line above [s]. If the first line has this form, all times count from the
//              moment when the script starts.
//   end        end of the script, by default at the time of the line above; must be the last line
// A line that begins with a word of `timeless` has the time of the line above. `forms`: valid lines, for errors.
// `take` gets each line except `end`; its error ends the reading.
error::Expected<ScriptTimes> read_script_lines(std::string_view text, std::string_view name, std::string_view forms,
                                               std::span<const std::string_view> timeless,
                                               const std::function<error::Expected<void>(const ScriptLine&)>& take);

// Time of a call: on the monotonic clock and in sim time.
struct Moment {
  std::int64_t monotonic_ns = 0;  // CLOCK_MONOTONIC
  std::int64_t sim_time_ns = 0;
};

// Message for the log and the flight recorder, such as the disconnection of a device.
struct Notice {
  bool is_warning = false;
  std::string text;
  bool for_pilot = false;  // an answer to a key, such as the help: for the log alone
};

// An event that the state machine has applied.
struct SeenEvent {
  databuffer::InputEvent event{};
  bool done = false;  // it changed the state or was for a tour; false: refused or without effect
  bool own = false;   // it came from this program's input lane
};

// A source of input events: a window, a terminal, a script, a device.
class EventSource {
 public:
  virtual ~EventSource() = default;

  // Waits for input or until deadline_ns(), at most `max_wait_ms`. May return early, for example on a signal.
  virtual void wait(const Moment& moment, int max_wait_ms);
  // Appends the file descriptors that become readable with new input. Returns false if the source has input without a
  // descriptor, so that only its own wait() detects this input.
  virtual bool add_descriptors(std::vector<pollfd>&) const { return true; }
  // Time [ns, CLOCK_MONOTONIC] at which take() is due even without new input, for an event or a check for devices.
  // nullopt: take() is due on input only.
  virtual std::optional<std::int64_t> deadline_ns() const { return std::nullopt; }
  // Returns events that no earlier call returned, without time stamps and sequence numbers. Never waits. A source may
  // leave a part of its input to the next call.
  virtual std::vector<databuffer::InputEvent> take(const Moment& moment) = 0;
  // Events for the end of the program: the end of a TDC press and of a TDC deflection.
  virtual std::vector<databuffer::InputEvent> release() = 0;

  // True if the user has quit (Escape; window or terminal closed) or a script has reached its `end`.
  virtual bool ended() const = 0;
  // True if events are due by simulation time. Then take() must be called once per tick.
  virtual bool follows_sim_time() const = 0;
  // Notices since the last call.
  virtual std::vector<Notice> notices() { return {}; }
  // True for a source with captions (tour.hpp).
  virtual bool has_captions() const { return false; }
  // The caption to show over the display; nullptr: none now.
  virtual const databuffer::Caption* caption() const { return nullptr; }
  // Takes events that the state machine has applied since the last call, of all senders. Call it before take().
  virtual void observe(const std::vector<SeenEvent>&) {}
  // Text for the log and the user: what the source reads, and how to use it.
  virtual std::string description() const = 0;
};

// Maximum time that a group waits in a source without a descriptor (a window): 5 ms, one tick. Meanwhile the group
// sees neither input nor deadlines of its other sources.
inline constexpr int kMaxOwnWait_ms = 5;

// Several sources as one source. If add_descriptors() is true for all sources, input of any source ends the wait of the
// group. Otherwise the group waits in the first source for which it is false, at most kMaxOwnWait_ms. The group ends
// when any source ends.
class SourceGroup final : public EventSource {
 public:
  explicit SourceGroup(std::vector<std::unique_ptr<EventSource>> sources) : sources_(std::move(sources)) {}

  void wait(const Moment& moment, int max_wait_ms) override;
  bool add_descriptors(std::vector<pollfd>& wanted) const override;
  std::optional<std::int64_t> deadline_ns() const override;
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override;
  bool follows_sim_time() const override;
  std::vector<Notice> notices() override;
  bool has_captions() const override;
  const databuffer::Caption* caption() const override;
  void observe(const std::vector<SeenEvent>& seen) override;
  std::string description() const override;

 private:
  std::vector<std::unique_ptr<EventSource>> sources_;
};

// Script: one event per line, with its simulation time. The syntax of times and of `end` is above. EVENT
// has the syntax of databuffer/messages/input_event.hpp. Except in lockstep, the input monitor ends with the script.
struct ScriptedEvent {
  std::int64_t time_ns = 0;
  databuffer::InputEvent event{};
};

struct Script {
  std::vector<ScriptedEvent> events;   // sorted by time, ascending
  std::optional<std::int64_t> end_ns;  // time of `end`; nullopt: the source does not end
  bool from_start = false;             // true: times count from the start of the script; false: simulation times
};

// `name`: file name for error messages.
error::Expected<Script> parse_script(std::string_view text, std::string_view name);

// Plays a script by simulation time. An event is due at the first tick at or after its time. At the start,
// events before the session's sim time are sent at once, in order. When sim time goes back (a reset), the script
// continues from the new time; a script with `from_start` begins again.
class ScriptSource final : public EventSource {
 public:
  ScriptSource(Script script, std::string name);
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override { return {}; }
  bool ended() const override { return ended_; }
  bool follows_sim_time() const override { return true; }
  std::string description() const override;

 private:
  Script script_;
  std::string name_;
  std::size_t next_ = 0;
  std::optional<std::int64_t> last_sim_time_ns_;  // nullopt: not started
  std::int64_t origin_ns_ = 0;                    // simulation time at time 0 of the script
  bool ended_ = false;
};

}  // namespace yars::inputmonitor
