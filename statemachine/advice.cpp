#include "statemachine/advice.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "lib/radar/mapping.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/view.hpp"
#include "lib/text/plain_text.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/designation.hpp"
#include "statemachine/maps.hpp"
#include "statemachine/picture_plane.hpp"
#include "statemachine/reasons.hpp"
#include "statemachine/remedies.hpp"
#include "statemachine/transition_table.hpp"

namespace yars::statemachine {

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using databuffer::PilotAdvice;
using databuffer::RadarState;

InputEvent event_of(EventKind kind, int argument = 0) {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(kind);
  event.argument = static_cast<std::int16_t>(argument);
  return event;
}

// An event tried on a copy of the state.
struct Trial {
  RadarState after;
  bool refused = false;
  bool changed = false;
};

Trial tried(Action action, const InputEvent& event, const RadarState& state, const Inputs& inputs,
            const Parameters& parameters) {
  Trial trial{state};
  Step step{trial.after, event, inputs, parameters};
  action(step);
  trial.refused = step.refused;
  trial.changed = !same_bytes(state, trial.after);
  return trial;
}

std::string refusal(const RadarState& after, const Inputs& inputs, const Parameters& parameters) {
  return text_of(Reason{std::string(text::text_of(after.message)), remedy_of_message(after, inputs, parameters)});
}

// The TDC's switch has no legend.
std::string new_setting(const ControlRow&, const RadarState&, const RadarState&) {
  return {};
}

// Reason and remedy of a button that is dead, or that would change nothing.
std::string idle_words(const RadarState& state, const InputEvent& event) {
  constexpr std::string_view kUnchanged = "changed nothing: ";
  std::string words = text_of(reason_without_effect(state, event));
  if (words.starts_with(kUnchanged)) words.erase(0, kUnchanged.size());
  return words;
}

std::string miles(double range_nm) {
  std::array<char, 24> buffer;
  std::snprintf(buffer.data(), buffer.size(), ": %g NM", range_nm);
  return buffer.data();
}

// What the press changes, seen in the legend: " off", ": 80 NM", ": HALF".
std::string new_setting(const ButtonRow& row, const RadarState& before, const RadarState& after) {
  if (row.boxed && row.boxed(after) != row.boxed(before)) return row.boxed(after) ? ": on" : ": off";
  if (after.range_nm != before.range_nm && after.mode == before.mode) return miles(after.range_nm);
  const std::string legend(row.legend.of(after));
  return legend.empty() || legend == row.legend.of(before) ? std::string() : ": " + legend;
}

// The words without the last alternatives of a remedy that a field of `size` characters cannot hold.
std::string shortened(std::string words, std::size_t size) {
  while (words.size() > size) {
    const std::size_t alternative = words.rfind(", "), remedy = words.rfind("; ");
    const std::size_t end = alternative != std::string::npos ? alternative : remedy;
    words.resize(end != std::string::npos ? end : size);
  }
  return words;
}

// Tries events on copies of one state, and puts what they do into words.
class Advisor {
 public:
  Advisor(const RadarState& state, const Inputs& inputs, const Parameters& parameters)
      : state_(state), inputs_(inputs), parameters_(parameters) {}

  // Puts the words of a button or of the TDC's switch; true if it has an effect. `row`: its live row, or nullptr.
  template <class Row, std::size_t N>
  bool put(char (&field)[N], const InputEvent& event, const Row* row) {
    refused_ = false;
    const std::string words = row == nullptr ? std::string() : words_of(event, *row);
    text::put_text(field, shortened(words.empty() ? idle_words(state_, event) : words, N - 1));
    return !words.empty() && !refused_;
  }

 private:
  // Empty if the event would change nothing.
  template <class Row>
  std::string words_of(const InputEvent& event, const Row& row) {
    const Trial trial = tried(row.action, event, state_, inputs_, parameters_);
    refused_ = trial.refused;
    if (trial.refused) return refusal(trial.after, inputs_, parameters_);
    return trial.changed ? row.does + new_setting(row, state_, trial.after) : std::string();
  }

  const RadarState& state_;
  const Inputs& inputs_;
  const Parameters& parameters_;
  bool refused_ = false;  // the last event tried was refused
};

// Appends words to a field of the advice if they fit it whole.
template <std::size_t N>
void append(char (&field)[N], const std::string& words) {
  const std::string all = std::string(text::text_of(field)) + words;
  if (all.size() < N) text::put_text(field, all);
}

bool acts_at_cursor(const RadarState& state) {
  return has(state, databuffer::kCursorValid) && shows_cursor(state) && !slews_steering_line(state);
}

// True if the display does not show the position. The TDC stops the cursor at the edge, up to rounding.
bool is_off(const PicturePlane& plane, geo::GeoPoint position) {
  constexpr double kAllowance_units = 0.5;
  const DisplayPoint at = plane.display_from_ground(position);
  const DisplayPoint inside{std::clamp(at.x, plane.view.width_min, plane.view.width_max),
                            std::clamp(at.y, plane.view.height_min, plane.view.height_max)};
  return plane.units_between(at, inside) > kAllowance_units;
}

// Adds to the words of the TDC's live switch which window a blank one stands for, and that the cursor cannot be seen.
void add_cursor_words(PilotAdvice& advice, const RadarState& state, const Inputs& inputs,
                      const Parameters& parameters) {
  const bool maps = state.cursor_function == static_cast<std::uint8_t>(radar::CursorFunction::map);
  const auto range = geo::Length::nautical_miles(state.cursor_range_nm);
  const auto window = radar::window_of_blank_selection(range, parameters.window_limits);
  if (maps && !(state.window_nm > 0.0) && window)
    append(advice.buttons[0], "; blank window" + miles(window->nautical_miles()) + "; acq fwd (PgUp)");
  const auto plane = plane_of(state, inputs, parameters.view);
  if (acts_at_cursor(state) && plane && is_off(*plane, cursor_of(state)))
    append(advice.buttons[0], "; off the display: tdc (arrows)");
}

}  // namespace

void advise(PilotAdvice& advice, const RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  text::put_text(advice.remedy, remedy_of_message(state, inputs, parameters));
  Advisor advisor(state, inputs, parameters);
  const InputEvent release = event_of(EventKind::tdc_release);
  advice.live = advisor.put(advice.buttons[0], release, live_control(state, release)) ? 1 : 0;
  if (advice.live != 0) add_cursor_words(advice, state, inputs, parameters);
  for (int button = 1; button <= radar::kBezelButtons; ++button) {
    const InputEvent press = event_of(EventKind::push_button, button);
    const bool live = advisor.put(advice.buttons[button], press, live_button(state, button));
    if (live) advice.live |= 1U << static_cast<unsigned>(button);
  }
}

void note_idle(PilotAdvice& advice, const IdleEvent& idle, const RadarState& state, const Inputs& inputs,
               const Parameters& parameters) {
  ++advice.idle_count;
  advice.idle_lane = idle.lane;
  advice.idle_number = idle.event.number;
  text::put_text(advice.idle_reason,
                 idle.refused ? refusal(state, inputs, parameters) : text_of(reason_without_effect(state, idle.event)));
}

}  // namespace yars::statemachine
