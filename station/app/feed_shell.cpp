#include "station/app/feed_shell.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "databuffer/json/status_json.hpp"
#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/key_map.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/receivers.hpp"
#include "display/symbology/help.hpp"
#include "lib/radar/modes.hpp"

namespace yars::station {

namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr std::int64_t kFrameInterval_ns = 25 * kNsPerMs;   // most frames a second: 40
constexpr std::int64_t kStateInterval_ns = 250 * kNsPerMs;  // of states without a change of the radar state

}  // namespace

error::Expected<StationFeed> StationFeed::create(databuffer::Session& session) {
  auto lane = runtime::InputLane::claim(session, "station");
  if (!lane) return tl::unexpected(lane.error());
  return StationFeed(session, std::move(*lane));
}

bool StationFeed::refresh() {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  const bool frame = refresh_frame(now_ns);
  const bool state = refresh_state(now_ns);
  return frame || state;
}

bool StationFeed::refresh_frame(std::int64_t now_ns) {
  if (now_ns - frame_ns_ < kFrameInterval_ns) return false;
  databuffer::GlassFrame frame{};  // a copy that failed may hold anything
  if (!databuffer::read_newest_frame(std::as_const(*session_).layout(), frame_id_, frame, pixels_)) return false;
  frame_id_ = frame.id;
  if (const auto reason = databuffer::validate(frame)) {
    session_->note(databuffer::NoteKind::refusal, "station: frame: " + *reason);
    return false;
  }
  frame_ns_ = now_ns;
  frames_.take(frame, pixels_);
  return true;
}

bool StationFeed::refresh_state(std::int64_t now_ns) {
  const auto& layout = std::as_const(*session_).layout();
  const bool changed = state_.refresh(layout.radar_state, *session_, "station: radar state") ||
                       advice_.refresh(layout.advice, *session_, "station: advice");
  if (!changed && now_ns < next_state_ns_) return false;
  next_state_ns_ = now_ns + kStateInterval_ns;
  model_.refresh(layout.model_status, *session_, "station: model status");
  advice_.refresh(layout.advice, *session_, "station: advice");
  input_.state = state_.value();
  input_.model = model_.value();
  input_.advice = advice_.value();
  const auto processes = session_->processes();
  input_.state_machine_alive = runtime::is_alive(processes, databuffer::Role::state_machine, now_ns);
  input_.model_alive = runtime::is_alive(processes, databuffer::Role::radar_model, now_ns);
  state_text_ = std::make_shared<const std::string>(state_message());
  ++state_number_;
  return true;
}

std::string StationFeed::state_message() const {
  nlohmann::ordered_json message;
  message["watch"] = databuffer::watch_json(databuffer::watch_of(*session_));
  auto& buttons = message["buttons"] = nlohmann::ordered_json::array();
  for (int button = 1; button <= radar::kBezelButtons; ++button)
    buttons.push_back(nlohmann::ordered_json{{"key", std::string(databuffer::key_of_button(button))},
                                             {"does", display::words_of_button(input_, button)}});
  message["recorder"] = session_->role_is_held(databuffer::Role::recorder);
  return message.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace yars::station
