// The surface traffic as a consumer latches it once a tick. A record that does not validate, or is of another epoch, is
// refused and counted; what was latched before goes on, for kTrafficStaleAfter.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/session_layout.hpp"

namespace yars::databuffer {

class TrafficReceiver {
 public:
  // True when latched() is another than before: a new record, or nothing any more.
  bool refresh(const SessionLayout& layout, std::int64_t tick, std::int64_t sim_time_ns, std::uint32_t epoch);
  const Traffic& latched() const { return latched_; }

  std::uint64_t refused() const { return refused_; }
  const std::optional<std::string>& refusal() const { return refusal_; }  // of the last refresh()

 private:
  bool take(const SessionLayout& layout, std::uint32_t epoch);

  Traffic latched_{};
  std::uint64_t version_ = 0;  // the newest looked at
  std::int64_t received_ns_ = 0;
  std::uint64_t refused_ = 0;
  std::optional<std::string> refusal_;
};

}  // namespace yars::databuffer
