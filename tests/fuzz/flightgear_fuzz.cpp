// Any bytes as a FlightGear packet: an error, or a sample that passes validation, as do samples extrapolated from it.
#include "flightmodel/bridges/bridge.hpp"
#include "tests/fuzz/flown_on.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace yars::flightmodel::bridges;
  if (const auto sample = decode_flightgear(std::as_bytes(std::span(data, size)))) fly_on(*sample);
  return 0;
}
