#include "statemachine/legends.hpp"

#include <array>
#include <cstddef>
#include <cstring>

#include "statemachine/transition_table.hpp"

namespace yars::statemachine {

namespace {

template <std::size_t N>
std::string_view nth(const std::array<std::string_view, N>& words, std::size_t index) {
  return index < N ? words[index] : std::string_view();
}

constexpr std::array<std::string_view, 4> kGains{"GAIN 0", "GAIN 1", "GAIN 2", "GAIN 3"};
constexpr std::array<std::string_view, 9> kChannels{"", "1", "2", "3", "4", "5", "6", "7", "8"};
constexpr std::array<std::string_view, 5> kBands{"A", "B", "C", "D", "E"};

}  // namespace

std::string_view gain_legend(const databuffer::RadarState& state) {
  return nth(kGains, state.gain);
}

std::string_view looks_legend(const databuffer::RadarState& state) {
  return has(state, databuffer::kMultiLook2) ? "ML2" : "ML1";
}

std::string_view mode_legend(const databuffer::RadarState& state) {
  // A patch map is a format of HRM.
  const radar::Mode mode = running_mode(state);
  return name_of(mode == radar::Mode::patch ? radar::Mode::hrm : mode);
}

std::string_view cursor_function_legend(const databuffer::RadarState& state) {
  return name_of(static_cast<radar::CursorFunction>(state.cursor_function));
}

std::string_view stabilizing_legend(const databuffer::RadarState& state) {
  return has(state, databuffer::kProgressive) ? "PROG" : "STAB";
}

std::string_view recall_legend(const databuffer::RadarState& state) {
  switch (static_cast<radar::Recall>(state.recall)) {
    case radar::Recall::old:
      return "OLD";
    case radar::Recall::store:
      return "STORE";
    default:
      return "NEW";  // also on a frozen HRM PPI: what the next press brings up
  }
}

std::string_view scan_legend(const databuffer::RadarState& state) {
  return name_of(static_cast<radar::ScanWidth>(state.scan));
}

std::string_view sequence_point_legend(const databuffer::RadarState& state) {
  return state.sequence_point;
}
std::string_view channel_legend(const databuffer::RadarState& state) {
  return nth(kChannels, state.channel);
}
std::string_view band_legend(const databuffer::RadarState& state) {
  return nth(kBands, state.band);
}

void write_legends(databuffer::RadarState& state) {
  std::memset(state.legends, 0, sizeof(state.legends));
  state.boxed = 0;
  const Columns column = button_column(state);
  for (const ButtonRow& row : button_rows()) {
    if ((row.columns & column) == 0 || !hold(row.shown_when, state)) continue;
    auto& legend = state.legends[row.button];
    row.legend.of(state).copy(legend, sizeof(legend) - 1);
    if (row.boxed && row.boxed(state)) state.boxed |= 1U << row.button;
  }
}

}  // namespace yars::statemachine
