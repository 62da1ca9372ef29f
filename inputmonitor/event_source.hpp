// Source of input events: the interface, several as one, and the script that is played by sim time.
#pragma once

#include <poll.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// Where events come from: a window, a terminal, a script, a device. A source knows no clock: it is told the time.
struct Moment {
  std::int64_t monotonic_ns = 0;  // [ns] CLOCK_MONOTONIC
  std::int64_t sim_time_ns = 0;   // [ns]
};

// What people should know of a source: a device that came or went.
struct News {
  bool is_trouble = false;
  std::string text;
};

class EventSource {
 public:
  virtual ~EventSource() = default;

  // Sleeps until there may be something to take, at most `longest_ms`; also returns early on a signal. A source that
  // nothing can wake sleeps that long.
  virtual void wait(const Moment& moment, int longest_ms);
  // Adds the descriptors that tell of something to take; false: only its own wait() can be told.
  virtual bool add_descriptors(std::vector<pollfd>&) const { return true; }
  // When there is something to take without any descriptor telling; none: not by itself.
  virtual std::optional<std::int64_t> deadline_ns() const { return std::nullopt; }
  // What has come until this moment, without times and number; never waits.
  virtual std::vector<databuffer::InputEvent> take(const Moment& moment) = 0;
  // What must be sent at the end, so that nothing stays held.
  virtual std::vector<databuffer::InputEvent> release() = 0;

  // The pilot is done, or the source is gone.
  virtual bool ended() const = 0;
  // Events are due by sim time: it wants to be asked once a tick.
  virtual bool follows_sim_time() const = 0;
  // What has happened to it since it was last asked.
  virtual std::vector<News> news() { return {}; }
  // For the log and for the pilot: what it reads and how to use it.
  virtual std::string description() const = 0;
};

// [ms] a source that no descriptor can wake, a window, leaves the others unheard no longer: one tick
inline constexpr int kLongestDeaf_ms = 5;

// Several sources as one: none waits for another. It ends when one of them does, as the keyboard by Escape.
class SourceGroup final : public EventSource {
 public:
  explicit SourceGroup(std::vector<std::unique_ptr<EventSource>> sources) : sources_(std::move(sources)) {}

  void wait(const Moment& moment, int longest_ms) override;
  bool add_descriptors(std::vector<pollfd>& wanted) const override;
  std::optional<std::int64_t> deadline_ns() const override;
  std::vector<databuffer::InputEvent> take(const Moment& moment) override;
  std::vector<databuffer::InputEvent> release() override;
  bool ended() const override;
  bool follows_sim_time() const override;
  std::vector<News> news() override;
  std::string description() const override;

 private:
  std::vector<std::unique_ptr<EventSource>> sources_;
};

// Events written down with their sim times, one a line:
//   TIME_S EVENT     sim time in seconds, not before the line above
//   +DT_S EVENT      so long after the line above; on the first line after the script's start, and then all times of
//                    the script count from its start
//   [TIME_S] end     the input monitor ends there, or right after the line above; nothing follows
// `#` begins a comment. EVENT is written as in databuffer/messages/input_event.hpp.
struct ScriptedEvent {
  std::int64_t time_ns = 0;
  databuffer::InputEvent event{};
};

struct Script {
  std::vector<ScriptedEvent> events;   // times never descend
  std::optional<std::int64_t> end_ns;  // none: it stays when all is sent
  bool from_start = false;             // times count from the script's start; else they are sim times
};

// `name` is the file's, for errors: they carry the line.
error::Expected<Script> parse_script(std::string_view text, std::string_view name);

// Plays a script by sim time: an event is due at the first tick at or after its time. What lies before the session's
// time when it begins is sent at once, in order. When sim time goes back (a reset), it goes on from there; a script
// whose times count from its start begins anew.
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
  std::optional<std::int64_t> last_sim_time_ns_;  // none: not begun
  std::int64_t origin_ns_ = 0;                    // sim time from which the script's times count
  bool ended_ = false;
};

}  // namespace yars::inputmonitor
