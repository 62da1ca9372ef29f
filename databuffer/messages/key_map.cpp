#include "databuffer/messages/key_map.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "lib/radar/modes.hpp"

namespace yars::databuffer {

namespace {

struct KeyAction {
  Key key;
  EventKind kind;
  int argument;
};

// Events of key presses. button_of() has the keys of the push buttons, deflection() the arrow keys.
constexpr std::array kKeyActions{
    KeyAction{Key::enter, EventKind::tdc_press, 0},
    KeyAction{Key::tab, EventKind::castle_up, 0},
    KeyAction{Key::page_up, EventKind::acquisition, 1},
    KeyAction{Key::page_down, EventKind::acquisition, -1},
    KeyAction{Key::space, EventKind::freeze, 0},
    KeyAction{Key{'['}, EventKind::elevation_step, -1},
    KeyAction{Key{']'}, EventKind::elevation_step, 1},
    KeyAction{Key{'n'}, EventKind::next, 0},
    KeyAction{Key::f4, EventKind::navigator, -1},
    KeyAction{Key::f5, EventKind::master_mode, static_cast<int>(radar::Master::air_to_ground)},
    KeyAction{Key::f6, EventKind::master_mode, static_cast<int>(radar::Master::air_to_air)},
    KeyAction{Key::f7, EventKind::master_mode, static_cast<int>(radar::Master::ranging)},
    KeyAction{Key{'o'}, EventKind::power, static_cast<int>(radar::Power::operate)},
    KeyAction{Key{'s'}, EventKind::power, static_cast<int>(radar::Power::standby)},
};

InputEvent event_of(EventKind kind, int argument = 0) {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(kind);
  event.argument = static_cast<std::int16_t>(argument);
  return event;
}

// Push button of a key: keys 2..9 are push buttons 2..9, keys a..k are push buttons 10..20.
std::optional<int> button_of(Key key) {
  const int character = static_cast<int>(key);
  if (character >= '2' && character <= '9') return character - '0';
  if (character >= 'a' && character <= 'k') return character - 'a' + 10;
  return std::nullopt;
}

bool is_arrow(Key key) {
  return key == Key::up || key == Key::down || key == Key::left || key == Key::right;
}

std::optional<InputEvent> event_of_key(Key key) {
  if (const auto button = button_of(key)) return event_of(EventKind::push_button, *button);
  const auto action = std::ranges::find(kKeyActions, key, &KeyAction::key);
  if (action == kKeyActions.end()) return std::nullopt;
  return event_of(action->kind, action->argument);
}

}  // namespace

Key key_of_character(char character) {
  if (character < ' ' || character > '~') return Key::none;
  const bool upper = character >= 'A' && character <= 'Z';
  return static_cast<Key>(upper ? character - 'A' + 'a' : character);
}

Key key_of_glfw(int code) {
  constexpr std::array<std::pair<int, Key>, 19> kNamed{{{GLFW_KEY_UP, Key::up},
                                                        {GLFW_KEY_DOWN, Key::down},
                                                        {GLFW_KEY_LEFT, Key::left},
                                                        {GLFW_KEY_RIGHT, Key::right},
                                                        {GLFW_KEY_ENTER, Key::enter},
                                                        {GLFW_KEY_KP_ENTER, Key::enter},
                                                        {GLFW_KEY_TAB, Key::tab},
                                                        {GLFW_KEY_PAGE_UP, Key::page_up},
                                                        {GLFW_KEY_PAGE_DOWN, Key::page_down},
                                                        {GLFW_KEY_ESCAPE, Key::escape},
                                                        {GLFW_KEY_F1, Key::f1},
                                                        {GLFW_KEY_F2, Key::f2},
                                                        {GLFW_KEY_F3, Key::f3},
                                                        {GLFW_KEY_F4, Key::f4},
                                                        {GLFW_KEY_F5, Key::f5},
                                                        {GLFW_KEY_F6, Key::f6},
                                                        {GLFW_KEY_F7, Key::f7},
                                                        {GLFW_KEY_F8, Key::f8},
                                                        {GLFW_KEY_F11, Key::f11}}};
  const auto* named = std::ranges::find(kNamed, code, &std::pair<int, Key>::first);
  if (named != kNamed.end()) return named->second;
  // The GLFW code of a printable key is the ASCII code of its upper case.
  return code >= ' ' && code <= '~' ? key_of_character(static_cast<char>(code)) : Key::none;
}

bool is_dead_letter(Key key) {
  const int code = static_cast<int>(key);
  const bool letter_or_digit = (code >= 'a' && code <= 'z') || (code >= '0' && code <= '9');
  return letter_or_digit && !event_of_key(key);
}

std::span<const KeyHelp> key_help() {
  static constexpr std::array kRows{
      KeyHelp{"arrows", "cursor (TDC)"},
      KeyHelp{"Enter", "TDC switch, acts on release"},
      KeyHelp{"Tab", "castle switch up: next point"},
      KeyHelp{"PgUp PgDn", "window up, down to blank; TGT: steering line"},
      KeyHelp{"Space", "freeze"},
      KeyHelp{"[ ]", "antenna down, up"},
      KeyHelp{"O S", "power OPR, STBY"},
      KeyHelp{"F4", "navigator MN, INS"},
      KeyHelp{"F5 F6 F7", "A/G, A/A, A/G ranging"},
  };
  return kRows;
}

std::string_view key_of_button(int button) {
  constexpr std::string_view kKeys = "23456789ABCDEFGHIJK";
  return button >= 2 && button <= radar::kBezelButtons ? kKeys.substr(static_cast<std::size_t>(button) - 2, 1)
                                                       : std::string_view();
}

InputEvent KeyboardState::deflection() const {
  const auto held = [this](Key key) { return held_.test(static_cast<std::size_t>(key)) ? 1.0 : 0.0; };
  InputEvent event = event_of(EventKind::tdc);
  event.x = held(Key::right) - held(Key::left);
  event.y = held(Key::up) - held(Key::down);
  return event;
}

std::vector<InputEvent> KeyboardState::change(Key key, bool pressed) {
  const auto index = static_cast<std::size_t>(key);
  if (key == Key::none || held_.test(index) == pressed) return {};
  const InputEvent before = deflection();
  held_.set(index, pressed);
  if (is_arrow(key)) {
    const InputEvent after = deflection();
    return before.x == after.x && before.y == after.y ? std::vector<InputEvent>{} : std::vector{after};
  }
  if (!pressed) return key == Key::enter ? std::vector{event_of(EventKind::tdc_release)} : std::vector<InputEvent>{};
  const auto event = event_of_key(key);
  return event ? std::vector{*event} : std::vector<InputEvent>{};
}

std::vector<InputEvent> KeyboardState::release_all() {
  const InputEvent deflected = deflection();
  std::vector<InputEvent> events;
  if (deflected.x != 0.0 || deflected.y != 0.0) events.push_back(event_of(EventKind::tdc));
  if (held_.test(static_cast<std::size_t>(Key::enter))) events.push_back(event_of(EventKind::tdc_release));
  held_.reset();
  return events;
}

}  // namespace yars::databuffer
