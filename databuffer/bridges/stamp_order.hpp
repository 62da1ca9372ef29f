// Whether a packet is news, by the stamp of its sender: one that is as old as the last, or a little older, came twice
// or out of order. A stamp that goes back by more than kLongestDelay is a sender that began again; that is believed
// once a second packet goes on from it, so that a single stray one moves nothing.
#pragma once

#include <optional>
#include <string>

#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

// What a network may hold a packet back by; longer and a sender that was started again waits that long to be heard.
inline constexpr geo::Duration kLongestDelay = geo::Duration::seconds(2.0);

class StampOrder {
 public:
  // `period`: a stamp counts to there and begins again at zero; none: it counts on. [s]
  explicit StampOrder(std::optional<geo::Duration> period = std::nullopt) : period_(period) {}

  // Nothing: it is news. Else why not. `stamp` is finite.
  std::optional<std::string> why_not_news(geo::Duration stamp);

 private:
  geo::Duration since(geo::Duration before, geo::Duration stamp) const;

  std::optional<geo::Duration> period_;
  std::optional<geo::Duration> last_;
  std::optional<geo::Duration> restarted_;  // stamp of a packet that may be a sender's first
};

}  // namespace yars::databuffer::bridges
