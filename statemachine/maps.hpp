// Patch maps in the radar state: command, completion, cancellation, freeze, recall and storage.
// Inputs: cursor, ownship, model status, records of maps.
// Outputs: map command; ids of NEW (newest map), OLD (last map of an earlier command, or a map that was stored),
//   STORE (stored by the pilot) and the map shown; messages.
#pragma once

#include <cstdint>

#include "statemachine/step.hpp"

namespace yars::statemachine {

// Freeze, recall of maps on the frozen picture, and SET.
// Source: docs/pilots_manual.md#rule-8, #rule-9, #rule-10, #rule-19, #rule-20, #rule-21.
void toggle_freeze(Step& step);
void flip_recall(Step& step);   // PB 10: toggles NEW and OLD, or with a stored map NEW and STORE
void toggle_store(Step& step);  // PB 15: stores the map shown, which PB 10 then shows instead of OLD; or releases it
void toggle_set(Step& step);    // PB 18: switches whether the cursor functions apply to the frozen map

void freeze(databuffer::RadarState& state);
void thaw(databuffer::RadarState& state);  // ends the freeze and recall, and clears the stored map

// Rule 19: freezes HRM while SNIFF is on.
void freeze_silent_hrm(databuffer::RadarState& state);

// Rule 21: leaving HRM for another master mode freezes the map shown, or on a PPI the newest map. The return to A/G
// ends that freeze unless SET is on. Source: the 1996 report, appendix A, "Set Function": "the last HRM map is
// automatically frozen".
void freeze_on_leaving(databuffer::RadarState& state);
void thaw_on_return(databuffer::RadarState& state);

// Id of the map that the display must show; 0 = none.
std::uint64_t map_to_show(const databuffer::RadarState& state);

// Command, completion and cancellation of maps.
// Source: docs/pilots_manual.md#rule-3, #rule-4, #rule-5, #rule-6, #rule-7, #rule-8.

// TDC release with cursor MAP: commands a map at the cursor. Refused with the reason if a radar limit forbids the map,
// or if no window fits the blank selection.
void command_map(Step& step);

// Cancels the commanded map: a new request number makes the model's result obsolete. Position and window in the state
// become those of the newest map, because in patch mode the radar model repeats the map at this position.
void cancel_map(databuffer::RadarState& state, const Inputs& inputs);

// Takes a completed map of the model. The commanded map becomes NEW; the stored map, or without one the former NEW,
// becomes OLD. take_map then returns true, and the caller enters patch mode. A re-map of the patch replaces NEW. Any
// other map is ignored. If the model could not make the commanded map, cancels the command and shows the reason.
bool take_map(databuffer::RadarState& state, const Inputs& inputs);

// While the radar model cannot re-map the patch, shows the model's reason as a message.
void show_remap_stop(databuffer::RadarState& state, const Inputs& inputs);

// Record of the map with this id; nullptr if there is none.
const databuffer::PatchMap* map_of(const Inputs& inputs, std::uint64_t id);

}  // namespace yars::statemachine
