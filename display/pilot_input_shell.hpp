// Clicks on the legends and keys typed on the glass, as events in an input lane of the session.
#pragma once

#include <cstdint>
#include <string_view>

#include "databuffer/records/key_map.hpp"
#include "databuffer/session.hpp"
#include "display/gl/window_glfw.hpp"

namespace yars::display {

class PilotInput {
 public:
  // `source`: who sends, as `yars status` shows it.
  static failure::Expected<PilotInput> create(databuffer::Session& session, std::string_view source);

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
