// Clicks on the legends and keys typed on the glass, as events in an input lane of the session.
#pragma once

#include <cstdint>

#include "databuffer/records/key_map.hpp"
#include "databuffer/session.hpp"
#include "display/gl/window_glfw.hpp"

namespace yars::display {

class PilotInput {
 public:
  static failure::Expected<PilotInput> create(databuffer::Session& session);

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
