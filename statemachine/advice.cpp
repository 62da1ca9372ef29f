#include "statemachine/advice.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/messages/model_records.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/view.hpp"
#include "lib/text/plain_text.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/designation.hpp"
#include "statemachine/maps.hpp"
#include "statemachine/remedies.hpp"
#include "statemachine/settings.hpp"
#include "statemachine/transition_table.hpp"

namespace yars::statemachine {

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using databuffer::RadarState;

bool is_kind(const InputEvent& event, EventKind kind) {
  return event.kind == static_cast<std::uint16_t>(kind);
}

// Words and remedy of an event that is dead because `condition` is not true. Of several missing conditions, the first
// in kMissing gives the reason.
struct MissingCondition {
  Conditions condition;
  const char* words;
  const char* remedy;
};
constexpr std::array kMissing{
    MissingCondition{kOperating, "dead in STBY", "switch on: power opr (O)"},
    MissingCondition{kThawed, "dead while frozen", "end the freeze: freeze (Space)"},
    MissingCondition{kFrozen, "dead unless frozen", "freeze first: freeze (Space)"},
    MissingCondition{kSniffOff, "dead while SNIFF is on", "end SNIFF: pb 18 (I)"},
    MissingCondition{kSetOff, "dead while SET is on", "end SET: pb 18 (I)"},
    MissingCondition{kSetOn, "dead without SET", "leave HRM with a map, then SET: pb 18 (I)"},
    MissingCondition{kHasMap, "dead without a map", "command a map first: tdc release (Enter)"},
    MissingCondition{kMapShown, "dead without a map on the display", "leave HRM with a map in memory"},
    MissingCondition{kCursorIsMap, "dead unless the cursor function is MAP", "select MAP: pb 7 (7)"},
    MissingCondition{kHasTarget, "dead without a target", "designate one first: tdc release (Enter)"}};

struct ColumnName {
  Columns column;
  const char* name;
};
constexpr std::array kColumnNames{ColumnName{kRbm, "RBM"}, ColumnName{kHrm, "HRM PPI"}, ColumnName{kPatch, "patch map"},
                                  ColumnName{kBcn, "BCN"}, ColumnName{kPvu, "PVU"}};

// "live in RBM, BCN"; empty if the event is live in no mode of A/G.
std::string live_modes(const InputEvent& event) {
  std::string modes;
  for (const ColumnName& one : kColumnNames)
    if ((columns_of(event) & one.column) != 0) modes += (modes.empty() ? "live in " : ", ") + std::string(one.name);
  return modes;
}

// Reason of an event without a row in the present column.
Reason reason_in_mode(const RadarState& state, const InputEvent& event) {
  const bool button = is_kind(event, EventKind::push_button);
  if (columns_of(event) == 0) return {"dead in every mode", {}};
  const auto mode = button ? static_cast<radar::Mode>(state.mode) : running_mode(state);
  std::string words = "dead in " + std::string(name_of(mode));
  if (mode == radar::Mode::menu) return {words, "back to the radar: pb 6 (6)"};
  if (mode == radar::Mode::air_to_air || mode == radar::Mode::ranging) return {words, "back to A/G: mode ag (F5)"};
  return {words, live_modes(event)};
}

Reason reason_without_update(const RadarState& state) {
  if (state.sequence_point[0] == '\0') return {"no sequence point is selected", "select one: sp 1"};
  if (has(state, databuffer::kUpdateInvalid)) return {"INV: the cursor is too old for an update", kRemedyForInv};
  if (!has(state, databuffer::kUpdateShown))
    return {"no update error is shown", "put the cursor onto the point's echo"};
  return {"changed nothing: the errors are 0", "move the cursor onto the point's echo (arrows)"};
}

bool acts_by(const RadarState& state, radar::CursorFunction function) {
  return state.cursor_function == static_cast<std::uint8_t>(function);
}

// Reason of an event that is live and changes nothing.
Reason reason_unchanged(const RadarState& state, const InputEvent& event) {
  constexpr int kRecallButton = 10, kPointButton = 17;
  const bool button = is_kind(event, EventKind::push_button);
  if (is_kind(event, EventKind::tdc_release) && acts_by(state, radar::CursorFunction::update))
    return reason_without_update(state);
  if (is_kind(event, EventKind::acquisition) && acts_by(state, radar::CursorFunction::target))
    return {"changed nothing: the line follows the line of sight", "turn it: acq aft (PgDn)"};
  if (is_kind(event, EventKind::castle_up) || (button && event.argument == kPointButton))
    return {"changed nothing: no other point is drawn", "select one by name: sp 1"};
  if (button && event.argument == kRecallButton)
    return {"changed nothing: there is no older map", "command another map: tdc release (Enter)"};
  return {"changed nothing: already at this value or at its limit", {}};
}

}  // namespace

std::string text_of(const Reason& reason) {
  return reason.remedy.empty() ? reason.words : reason.words + "; " + reason.remedy;
}

Reason reason_without_effect(const RadarState& state, const InputEvent& event) {
  if (action_for(state, event)) return reason_unchanged(state, event);
  if (power_of(state) == radar::Power::off) return {"dead while the power is OFF", "switch on: power opr (O)"};
  const auto missing = missing_conditions(state, event);
  if (!missing) return reason_in_mode(state, event);
  const auto first = std::ranges::find_if(
      kMissing, [missing](const MissingCondition& one) { return (*missing & one.condition) != 0; });
  if (first != kMissing.end()) return {first->words, first->remedy};
  return {reason_in_mode(state, event).words + " with this cursor function", "step the cursor function: pb 7 (7)"};
}

namespace {

// True if none of the events changed a setting of the radar: only events with kEventDone do.
bool all_without_change(std::span<const std::uint32_t> effects) {
  return std::ranges::find(effects, databuffer::kEventDone) == effects.end();
}

std::optional<Reason> reason_dead(const AppliedSequence& applied, std::size_t index) {
  const InputEvent& event = applied.events[index];
  if (all_without_change(applied.effects.subspan(index + 1))) return reason_without_effect(applied.after, event);
  if (all_without_change(applied.effects.first(index))) return reason_without_effect(applied.before, event);
  return std::nullopt;
}

// True if a later event may have replaced the message: a refused event shows its reason, and a TDC release may store a
// mark, which shows the mark's number.
bool message_is_replaced(const AppliedSequence& applied, std::size_t index) {
  for (std::size_t later = index + 1; later < applied.events.size(); ++later) {
    const bool done = applied.effects[later] == databuffer::kEventDone;
    if (applied.effects[later] == databuffer::kEventRefused) return true;
    if (done && is_kind(applied.events[later], EventKind::tdc_release)) return true;
  }
  return false;
}

std::optional<Reason> reason_refused(const AppliedSequence& applied, std::size_t index) {
  const InputEvent& event = applied.events[index];
  const std::string message(text::text_of(applied.after.message));
  const auto with_remedy = [&](std::string words) {
    const bool shown = words == message;
    return Reason{std::move(words), shown ? applied.remedy : std::string()};
  };
  // The reasons for an unknown point and for the recorder do not depend on the other events. PB 12, for the
  // recorder, is the only button that can be refused.
  if (is_kind(event, EventKind::sequence_point)) return with_remedy(no_such_point(text::text_of(event.text)));
  if (is_kind(event, EventKind::push_button))
    return with_remedy(std::string(recorder_problem(applied.recorder_present)));
  return message.empty() || message_is_replaced(applied, index) ? std::nullopt : std::optional(with_remedy(message));
}

}  // namespace

std::optional<Reason> certain_reason(const AppliedSequence& applied, std::size_t index) {
  return applied.effects[index] == databuffer::kEventRefused ? reason_refused(applied, index)
                                                             : reason_dead(applied, index);
}

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
