#include "databuffer/records/radar_command.hpp"

#include "lib/radar/modes.hpp"

namespace yars::databuffer {

RadarCommand command_from_state(const RadarState& state) {
  RadarCommand command{};
  command.range_nm = state.range_nm;
  command.scan_width_deg = state.scan_width_deg;
  command.antenna_elevation_deg = state.antenna_elevation_deg;
  command.cursor_latitude_deg = state.cursor_latitude_deg;
  command.cursor_longitude_deg = state.cursor_longitude_deg;
  command.window_nm = state.window_nm;
  command.scan_restart = state.scan_restart;
  command.flags =
      state.flags & (kFreeze | kSniff | kIpvu | kMultiLook2 | kProgressive | kCursorValid | kMapping | kMapWindowBlank);
  command.power = state.power;
  // Under the main menu the radar keeps running in the mode below it.
  const bool menu = state.mode == static_cast<std::uint8_t>(radar::Mode::menu);
  command.mode = menu ? state.resume_mode : state.mode;
  command.scan = state.scan;
  command.gain = state.gain;
  command.range_index = state.range_index;
  command.channel = state.channel;
  command.band = state.band;
  command.map_latitude_deg = state.map_latitude_deg;
  command.map_longitude_deg = state.map_longitude_deg;
  command.map_window_nm = static_cast<float>(state.map_window_nm);
  command.map_request = state.map_request;
  return command;
}

}  // namespace yars::databuffer
