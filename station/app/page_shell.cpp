#include "station/app/page_shell.hpp"

#include <optional>
#include <variant>
#include <vector>

namespace yars::station {

namespace {

using nlohmann::ordered_json;

Text text_of(const ordered_json& message) {
  return std::make_shared<const std::string>(message.dump(-1, ' ', true, ordered_json::error_handler_t::replace));
}

void answer(OpenPage& page, std::int64_t id, const std::optional<std::string>& problem) {
  page.tell(std::make_shared<const std::string>(answer_to(id, problem)));
}

void answer_outcome(OpenPage& page, std::int64_t id, const error::Expected<void>& outcome) {
  answer(page, id, outcome ? std::nullopt : std::optional(outcome.error().message()));
}

// Answers with the name of the session that was started.
void answer_session(OpenPage& page, std::int64_t id, const error::Expected<std::string>& session) {
  if (!session) return answer(page, id, session.error().message());
  page.tell(text_of({{"answer", id}, {"problem", nullptr}, {"session", *session}}));
}

void carry_out(Site& site, SessionFeed& feed, const std::shared_ptr<OpenPage>& page, const InstructorMessage& message) {
  const auto id = message.id;
  if (const auto* play = std::get_if<PlayRecording>(&message.command))
    return answer_session(*page, id, site.sets.play(play->file, play->at_s));
  if (const auto* out = std::get_if<FlyOut>(&message.command))
    return answer_session(*page, id, site.sets.fly_out(out->file, out->at_s));
  if (std::holds_alternative<StartRecorder>(message.command)) return answer_outcome(*page, id, site.sets.record());
  if (const auto* end = std::get_if<EndSet>(&message.command))
    return answer_outcome(*page, id, site.sets.end(end->session));
  if (std::holds_alternative<ListRecordings>(message.command))
    return site.sets.list_recordings([id, waiting = std::weak_ptr(page)](ordered_json list) {
      const auto there = waiting.lock();
      if (!there) return;
      if (list.contains("problem")) return answer(*there, id, list["problem"].get<std::string>());
      there->tell(text_of({{"answer", id}, {"problem", nullptr}, {"recordings", list["recordings"]}}));
    });
  feed.instructor.execute(message.command, [id, waiting = std::weak_ptr(page)](const error::Expected<void>& outcome) {
    if (const auto there = waiting.lock()) answer_outcome(*there, id, outcome);
  });
}

}  // namespace

bool take_message(Site& site, SessionFeed& feed, PagePilot& pilot, const std::shared_ptr<OpenPage>& page, Right right,
                  const std::string& message) {
  const auto object =
      message.size() > kMaxMessageBytes ? nlohmann::json() : nlohmann::json::parse(message, nullptr, false);
  const bool commands = object.is_object() && object.contains("do");
  const auto command = commands ? instructor_message(object) : error::Expected<InstructorMessage>();
  const auto events = commands ? error::Expected<std::vector<databuffer::InputEvent>>() : pilot.events_of(message);
  if (commands && !command) {
    const auto id = object.find("id");
    answer(*page, id != object.end() && id->is_number_integer() ? id->get<std::int64_t>() : 0,
           command.error().message());
    return true;
  }
  if (!events) {
    log::warning("a page is refused: " + events.error().message());
    return false;
  }
  if (right != Right::instructor) {
    if (commands || !events->empty())
      answer(*page, commands ? command->id : 0, "expected the token of an instructor, found that of a viewer");
    return true;
  }
  for (const databuffer::InputEvent& event : *events) feed.display->send(event);
  if (commands) carry_out(site, feed, page, *command);
  return true;
}

}  // namespace yars::station
