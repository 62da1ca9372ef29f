#include "statemachine/reasons.hpp"

#include <algorithm>

#include "databuffer/messages/model_records.hpp"
#include "lib/text/plain_text.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/settings.hpp"
#include "statemachine/transition_table.hpp"

namespace yars::statemachine {

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;

bool is_kind(const InputEvent& event, EventKind kind) {
  return event.kind == static_cast<std::uint16_t>(kind);
}

// True if none of the events changed a setting of the radar: only events with kEventDone do.
bool all_without_change(std::span<const std::uint32_t> effects) {
  return std::ranges::find(effects, databuffer::kEventDone) == effects.end();
}

std::optional<std::string> reason_dead(const AppliedSequence& applied, std::size_t index) {
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

std::optional<std::string> reason_refused(const AppliedSequence& applied, std::size_t index) {
  const InputEvent& event = applied.events[index];
  // The reasons for an unknown point and for the recorder do not depend on the other events. PB 12, for the
  // recorder, is the only button that can be refused.
  if (is_kind(event, EventKind::sequence_point)) return no_such_point(text::text_of(event.text));
  if (is_kind(event, EventKind::push_button)) return std::string(recorder_problem(applied.recorder_present));
  const std::string message(text::text_of(applied.after.message));
  return message.empty() || message_is_replaced(applied, index) ? std::nullopt : std::optional(message);
}

}  // namespace

std::optional<std::string> certain_reason(const AppliedSequence& applied, std::size_t index) {
  return applied.effects[index] == databuffer::kEventRefused ? reason_refused(applied, index)
                                                             : reason_dead(applied, index);
}

}  // namespace yars::statemachine
