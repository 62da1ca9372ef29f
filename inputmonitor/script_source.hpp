// Plays a script by sim time: an event is due at the first tick at or after its time. What lies before the session's
// time when it begins is sent at once, in order. When sim time goes back (a reset), it goes on from there; a script
// whose times count from its start begins anew.
#pragma once

#include <optional>
#include <string>

#include "inputmonitor/event_source.hpp"
#include "inputmonitor/script.hpp"

namespace yars::inputmonitor {

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
