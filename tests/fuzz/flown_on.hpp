// Check for all packet decoders: a sample passes validation, and so do samples extrapolated from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/bridges/external_flight.hpp"
#include "lib/error/error.hpp"

namespace yars::flightmodel::bridges {

inline void require_valid(const databuffer::Ownship& ownship) {
  YARS_REQUIRE(validate(ownship).value_or(""), ==, "");
}

// Requires that the sample and its extrapolations are valid. The sample is received twice, because the state after the
// first reception affects the second.
inline void fly_on(const ExternalSample& sample) {
  require_valid(sample.ownship);
  ExternalFlight flight(geo::Duration::seconds(12.0));
  for (const double received_s : {1.0, 1.2}) {
    flight.receive(sample, geo::Duration::seconds(received_s));
    for (const double after_s : {-0.1, 0.0, 0.02, 5.0})
      if (const auto flown = flight.at(geo::Duration::seconds(received_s + after_s))) {
        require_valid(flown->ownship);
        YARS_REQUIRE(validate(flown->nav).value_or(""), ==, "");
      }
  }
}

// Calls `take` for each datagram of the input. In the input two bytes with its length precede each datagram.
template <class Take>
void each_datagram(std::span<const std::byte> bytes, Take take) {
  while (bytes.size() > 2) {
    const std::size_t stated_bytes =
        std::to_integer<std::size_t>(bytes[0]) << 8U | std::to_integer<std::size_t>(bytes[1]);
    bytes = bytes.subspan(2);
    const std::size_t length = stated_bytes < bytes.size() ? stated_bytes : bytes.size();
    take(bytes.first(length));
    bytes = bytes.subspan(length);
  }
}

}  // namespace yars::flightmodel::bridges
