// Bytes of struct input_event (linux/input.h, this machine's layout), cut anywhere, into events. Any bytes are allowed;
// a record whose end has not come yet is kept.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "inputmonitor/raw_event.hpp"

namespace yars::inputmonitor {

inline constexpr std::size_t kRecordBytes = 24;

class RecordStream {
 public:
  std::vector<RawEvent> feed(std::span<const std::byte> bytes);
  // Another stream begins: half a record is forgotten.
  void restart() { kept_ = 0; }

 private:
  std::array<std::byte, kRecordBytes> record_{};
  std::size_t kept_ = 0;  // bytes of record_ that have come
};

}  // namespace yars::inputmonitor
