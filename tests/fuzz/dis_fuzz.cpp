// Any bytes as DIS packets: the input as one datagram, then as a sequence of datagrams. The aircraft's samples and the
// surface traffic pass validation.
#include "flightmodel/bridges/bridge_source.hpp"
#include "flightmodel/bridges/dis.hpp"
#include "tests/fuzz/flown_on.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace yars::databuffer;
  using namespace yars::flightmodel::bridges;
  const auto bytes = std::as_bytes(std::span(data, size));
  DisBridge bridge(std::nullopt, std::nullopt, yars::geo::Geoid("/nowhere"));
  const auto take = [&bridge](std::span<const std::byte> datagram) {
    const auto sample = bridge.receive(datagram, yars::geo::Duration::seconds(1.0));
    if (sample && *sample) fly_on(**sample);
  };
  take(bytes);
  each_datagram(bytes, take);
  const Traffic traffic = surface_traffic(bridge.traffic(yars::geo::Duration::seconds(10.0)), {36.5, -122.0});
  YARS_REQUIRE(validate(traffic).value_or(""), ==, "");
  return 0;
}
