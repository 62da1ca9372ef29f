#include "display/pilot_input_shell.hpp"

#include "databuffer/log.hpp"
#include "databuffer/records/event_text.hpp"
#include "display/bezel.hpp"

namespace yars::display {

failure::Expected<PilotInput> PilotInput::create(databuffer::Session& session, std::string_view source) {
  auto claim = session.claim_input_lane(source);
  if (!claim) return tl::unexpected(claim.error());
  return PilotInput(session, std::move(*claim));
}

void PilotInput::press(int button) {
  databuffer::InputEvent event{};
  event.kind = static_cast<std::uint16_t>(databuffer::EventKind::push_button);
  event.argument = static_cast<std::int16_t>(button);
  push(event);
}

bool PilotInput::click(Point at) {
  const auto button = button_at(at);
  if (button) press(*button);
  return button.has_value();
}

void PilotInput::send(const gl::WindowInput& input) {
  for (const Point at : input.clicks) click(at);
  for (const gl::KeyEdge& edge : input.keys) {
    for (const databuffer::InputEvent& event : keyboard_.change(edge.key, edge.pressed)) push(event);
  }
  if (input.focus_lost) release_all();
}

void PilotInput::release_all() {
  for (const databuffer::InputEvent& event : keyboard_.release_all()) push(event);
}

void PilotInput::push(databuffer::InputEvent event) {
  event.session_time_ns = session_->sim_time_ns();
  event.monotonic_ns = databuffer::monotonic_ns();
  event.number = ++number_;
  if (session_->layout().input.push(static_cast<std::size_t>(claim_.lane()), event)) return;
  databuffer::log_warning("the state machine takes no events: '" + databuffer::text_of(event) + "' is dropped");
}

}  // namespace yars::display
