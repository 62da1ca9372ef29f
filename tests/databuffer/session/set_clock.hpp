// Publishes a clock in a session, as `yars sim` does.
#pragma once

#include "databuffer/session/session.hpp"

namespace yars::test {

inline error::Expected<void> set_clock(databuffer::Session& session, const databuffer::ClockState& state) {
  return session.change_clock([&state](const databuffer::ClockState&) { return state; });
}

}  // namespace yars::test
