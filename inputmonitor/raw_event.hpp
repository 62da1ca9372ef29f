// What a device of the kernel's input layer says: struct input_event without its time.
#pragma once

#include <cstdint>

namespace yars::inputmonitor {

struct RawEvent {
  std::uint16_t type = 0;  // EV_SYN, EV_KEY, EV_ABS ...
  std::uint16_t code = 0;
  std::int32_t value = 0;
};

}  // namespace yars::inputmonitor
