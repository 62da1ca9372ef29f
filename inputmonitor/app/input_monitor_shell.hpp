// Shells of input-monitor: a source in a session, and learning a device on the terminal.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "databuffer/runtime/tick_loop.hpp"
#include "databuffer/session/session.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// An event source in a session: waits for it, or asks it once a tick, and pushes what it gives into the input lane.
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

// `input-monitor --learn PATH [--out FILE]`: asks on the terminal, listens to the device, writes the map as GUF. Needs
// no session. An error when the device cannot be read, goes before anything is learned, or the file cannot be written.
// `file` empty: the map goes to standard output and all else to standard error.
error::Expected<void> learn_device(const std::string& path, const std::string& file);

}  // namespace yars::inputmonitor
