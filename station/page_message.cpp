#include "station/page_message.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace yars::station {

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using databuffer::Key;

tl::unexpected<error::Error> refused(std::string found) {
  return error::fail("message", R"({"event": TEXT}, {"key": NAME, "down": true|false} or {"release": true})",
                     std::move(found));
}

InputEvent centred_tdc() {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(EventKind::tdc);
  return event;
}

}  // namespace

Key key_of_browser(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Key>, 13> kNamed{{{"ArrowUp", Key::up},
                                                                            {"ArrowDown", Key::down},
                                                                            {"ArrowLeft", Key::left},
                                                                            {"ArrowRight", Key::right},
                                                                            {"Enter", Key::enter},
                                                                            {"Tab", Key::tab},
                                                                            {"PageUp", Key::page_up},
                                                                            {"PageDown", Key::page_down},
                                                                            {"F4", Key::f4},
                                                                            {"F5", Key::f5},
                                                                            {"F6", Key::f6},
                                                                            {"F7", Key::f7},
                                                                            {"Spacebar", Key::space}}};
  if (name.size() == 1) return databuffer::key_of_character(name.front());
  const auto* named = std::ranges::find(kNamed, name, &std::pair<std::string_view, Key>::first);
  return named == kNamed.end() ? Key::none : named->second;
}

error::Expected<std::vector<InputEvent>> PagePilot::events_of(std::string_view message) {
  if (message.size() > kMaxMessageBytes) return refused(std::to_string(message.size()) + " bytes");
  const auto object = nlohmann::json::parse(message, nullptr, false);
  if (!object.is_object()) return refused("something else");
  if (const auto event = object.find("event"); event != object.end()) {
    if (!event->is_string()) return refused("an event that is no text");
    const auto parsed = databuffer::event_from_text(event->get_ref<const std::string&>());
    if (!parsed) return tl::unexpected(parsed.error());
    if (static_cast<EventKind>(parsed->kind) == EventKind::tdc) deflected_ = parsed->x != 0.0 || parsed->y != 0.0;
    return std::vector{*parsed};
  }
  if (const auto key = object.find("key"); key != object.end()) {
    const auto down = object.find("down");
    if (!key->is_string() || down == object.end() || !down->is_boolean()) return refused("a key without both");
    return keyboard_.change(key_of_browser(key->get_ref<const std::string&>()), down->get<bool>());
  }
  if (object.contains("release")) return release_all();
  return refused("an object without them");
}

std::vector<InputEvent> PagePilot::release_all() {
  std::vector<InputEvent> events = keyboard_.release_all();
  if (std::exchange(deflected_, false)) events.push_back(centred_tdc());
  return events;
}

}  // namespace yars::station
