// The words beside the buttons. Source: docs/spec/pilots_interface.md#legends.
#pragma once

#include <string_view>

#include "databuffer/records/radar_state.hpp"

namespace yars::statemachine {

std::string_view gain_legend(const databuffer::RadarState& state);
std::string_view looks_legend(const databuffer::RadarState& state);
std::string_view mode_legend(const databuffer::RadarState& state);
std::string_view cursor_function_legend(const databuffer::RadarState& state);
std::string_view stabilizing_legend(const databuffer::RadarState& state);
std::string_view recall_legend(const databuffer::RadarState& state);
std::string_view scan_legend(const databuffer::RadarState& state);
std::string_view sequence_point_legend(const databuffer::RadarState& state);
std::string_view channel_legend(const databuffer::RadarState& state);
std::string_view band_legend(const databuffer::RadarState& state);

// Fills `legends` and `boxed` from the transition table.
void write_legends(databuffer::RadarState& state);

}  // namespace yars::statemachine
