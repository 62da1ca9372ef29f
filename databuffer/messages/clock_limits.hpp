// Limit of the session's clock that users meet: commands, forms and pages check against it.
// Source: ClockState::rate in world_state.idl, whose range is the same.
#pragma once

namespace yars::databuffer {

inline constexpr double kMaxClockRate = 10.0;  // sim time / real time; at higher rates programs skip late ticks

}  // namespace yars::databuffer
