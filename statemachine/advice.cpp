#include "statemachine/advice.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"
#include "statemachine/maps.hpp"
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

// Puts the text of one button or switch; returns true if it has an effect.
template <std::size_t N>
bool put_words(char (&field)[N], const std::string& words, bool live) {
  put_text(field, words);
  return live;
}

bool advise_button(PilotAdvice& advice, int button, const RadarState& state, const Inputs& inputs,
                   const Parameters& parameters) {
  const InputEvent event = event_of(EventKind::push_button, button);
  auto& field = advice.buttons[button];
  const ButtonRow* row = live_button(state, button);
  if (row == nullptr) return put_words(field, idle_words(state, event), false);
  const Trial trial = tried(row->action, event, state, inputs, parameters);
  if (trial.refused) return put_words(field, refusal(trial.after, inputs, parameters), false);
  if (!trial.changed) return put_words(field, idle_words(state, event), false);
  return put_words(field, row->does + new_setting(*row, state, trial.after), true);
}

bool advise_tdc_switch(PilotAdvice& advice, const RadarState& state, const Inputs& inputs,
                       const Parameters& parameters) {
  const InputEvent event = event_of(EventKind::tdc_release);
  auto& field = advice.buttons[0];
  const ControlRow* row = live_control(state, event);
  if (row == nullptr) return put_words(field, idle_words(state, event), false);
  const Trial trial = tried(row->action, event, state, inputs, parameters);
  if (trial.refused) return put_words(field, refusal(trial.after, inputs, parameters), false);
  if (!trial.changed) return put_words(field, idle_words(state, event), false);
  return put_words(field, row->does, true);
}

}  // namespace

void advise(PilotAdvice& advice, const RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  put_text(advice.remedy, remedy_of_message(state, inputs, parameters));
  advice.live = advise_tdc_switch(advice, state, inputs, parameters) ? 1 : 0;
  for (int button = 1; button <= radar::kBezelButtons; ++button)
    if (advise_button(advice, button, state, inputs, parameters)) advice.live |= 1U << static_cast<unsigned>(button);
}

void note_idle(PilotAdvice& advice, const IdleEvent& idle, const RadarState& state, const Inputs& inputs,
               const Parameters& parameters) {
  ++advice.idle_count;
  advice.idle_lane = idle.lane;
  advice.idle_number = idle.event.number;
  put_text(advice.idle_reason,
           idle.refused ? refusal(state, inputs, parameters) : text_of(reason_without_effect(state, idle.event)));
}

}  // namespace yars::statemachine
