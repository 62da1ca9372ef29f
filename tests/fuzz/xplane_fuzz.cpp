// Any bytes as X-Plane's replies: the input as one datagram, then as a sequence of datagrams. Samples pass validation.
#include "flightmodel/bridges/bridge.hpp"
#include "tests/fuzz/flown_on.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace yars::flightmodel::bridges;
  const auto bytes = std::as_bytes(std::span(data, size));
  XplaneBridge bridge;
  const auto take = [&bridge](std::span<const std::byte> datagram) {
    const auto sample = bridge.receive(datagram, {});
    if (sample && *sample) fly_on(**sample);
  };
  take(bytes);
  each_datagram(bytes, take);
  return 0;
}
