// An event source in a session: waits for it, or asks it once a tick, and pushes what it gives into the input lane.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "databuffer/session.hpp"
#include "databuffer/tick_loop.hpp"
#include "inputmonitor/event_source.hpp"

namespace yars::inputmonitor {

class InputMonitorShell {
 public:
  InputMonitorShell(databuffer::Session& session, std::unique_ptr<EventSource> source, int lane);

  // Until the source has ended or the program is asked to stop. In lockstep it goes on stepping after the source has
  // ended, for the others would wait.
  void run(databuffer::TickLoop& loop);

 private:
  void run_by_ticks(databuffer::TickLoop& loop);
  void run_by_input();
  void tell_news();
  void push(const std::vector<databuffer::InputEvent>& events, const Moment& moment);

  databuffer::Session* session_;
  std::unique_ptr<EventSource> source_;
  std::size_t lane_;
  std::uint32_t number_ = 0;
};

}  // namespace yars::inputmonitor
