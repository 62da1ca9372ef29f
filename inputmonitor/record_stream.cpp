#include "inputmonitor/record_stream.hpp"

#include <linux/input.h>

#include <algorithm>
#include <bit>

namespace yars::inputmonitor {

static_assert(sizeof(input_event) == kRecordBytes);

std::vector<RawEvent> RecordStream::feed(std::span<const std::byte> bytes) {
  std::vector<RawEvent> events;
  events.reserve((kept_ + bytes.size()) / kRecordBytes);
  while (!bytes.empty()) {
    const std::size_t count = std::min(bytes.size(), kRecordBytes - kept_);
    std::copy_n(bytes.begin(), count, record_.begin() + static_cast<std::ptrdiff_t>(kept_));
    kept_ += count;
    bytes = bytes.subspan(count);
    if (kept_ < kRecordBytes) break;
    kept_ = 0;
    const auto record = std::bit_cast<input_event>(record_);
    events.push_back({record.type, record.code, record.value});
  }
  return events;
}

}  // namespace yars::inputmonitor
