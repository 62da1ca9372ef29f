#include "statemachine/switches.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "statemachine/freezing.hpp"
#include "statemachine/maps.hpp"

namespace yars::statemachine {

namespace {

constexpr int kGreatestLevel = 15;  // brightness and contrast; the record and the glass scale by it
constexpr std::uint8_t kGreatestGain = 3;
constexpr std::uint8_t kChannels = 8;
constexpr std::uint8_t kBands = 5;
// 3 s: long enough to read two words, short enough not to hide the next; a shorter one is missed in a scan of the
// panel.
constexpr std::int64_t kMessageTicks = 600;
constexpr std::string_view kRecorderFull = "VTR FULL";

void toggle(Step& step, std::uint32_t flag) {
  step.state.flags ^= flag;
}

void step_level(std::uint8_t& level, int by) {
  level = static_cast<std::uint8_t>(std::clamp(level + by, 0, kGreatestLevel));
}

}  // namespace

void toggle_declutter(Step& step) {
  toggle(step, databuffer::kDeclutter);
}
void toggle_looks(Step& step) {
  toggle(step, databuffer::kMultiLook2);
}
void toggle_stabilizing(Step& step) {
  toggle(step, databuffer::kProgressive);
}
void toggle_ipvu(Step& step) {
  toggle(step, databuffer::kIpvu);
}

void cycle_gain(Step& step) {
  std::uint8_t& gain = step.state.gain;
  gain = gain == 0 ? kGreatestGain : static_cast<std::uint8_t>(gain - 1);
}

void brightness_up(Step& step) {
  step_level(step.state.brightness, 1);
}
void brightness_down(Step& step) {
  step_level(step.state.brightness, -1);
}
void step_contrast(Step& step) {
  step_level(step.state.contrast, std::clamp<int>(step.event.argument, -1, 1));
}

void toggle_recorder(Step& step) {
  if (!step.surroundings.recorder_present) {
    refuse(step, "NO RECORDER");
  } else if (step.surroundings.recorder_failed) {
    refuse(step, kRecorderFull);
  } else {
    ++step.state.vtr_request;
  }
}

// The box is what the recorder says, not what was asked for.
void advance_recorder(databuffer::RadarState& state, const Surroundings& surroundings) {
  const bool wrote = has(state, databuffer::kVtr);
  set_flag(state, databuffer::kVtr, surroundings.recorder_present && surroundings.recorder_writing);
  if (wrote && surroundings.recorder_present && surroundings.recorder_failed)
    show_message(state, surroundings, kRecorderFull);
}

void toggle_sniff(Step& step) {
  toggle(step, databuffer::kSniff);
  // A map is made by transmitting; HRM stops that at once.
  if (has(step.state, databuffer::kSniff)) cancel_map(step.state, step.surroundings);
  freeze_silent_hrm(step.state);
}

void next_channel(Step& step) {
  step.state.channel = static_cast<std::uint8_t>(step.state.channel % kChannels + 1);
}

void next_band(Step& step) {
  step.state.band = static_cast<std::uint8_t>((step.state.band + 1) % kBands);
}

void select_navigator(Step& step) {
  constexpr std::int16_t kToggle = -1;
  const std::int16_t argument = step.event.argument;
  if (argument == kToggle) {
    step.state.navigator ^= 1U;
  } else if (argument >= 0 && argument <= static_cast<std::int16_t>(radar::Navigator::ins)) {
    step.state.navigator = static_cast<std::uint8_t>(argument);
  }
}

void switch_altimeter(Step& step) {
  set_flag(step.state, databuffer::kAltimeterFailed, step.event.argument == 0);
}

void show_message(databuffer::RadarState& state, const Surroundings& surroundings, std::string_view text) {
  std::memset(state.message, 0, sizeof(state.message));
  text.copy(state.message, sizeof(state.message) - 1);
  state.message_until_tick = surroundings.tick + kMessageTicks;
}

void refuse(Step& step, std::string_view reason) {
  show_message(step.state, step.surroundings, reason);
  step.refused = true;
}

}  // namespace yars::statemachine
