#include "inputmonitor/event_source.hpp"

#include <poll.h>

namespace yars::inputmonitor {

void EventSource::wait(const Moment&, int longest_ms) {
  poll(nullptr, 0, longest_ms);
}

}  // namespace yars::inputmonitor
