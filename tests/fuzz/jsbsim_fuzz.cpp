// Any text as JSBSim's output, one datagram per line, with labels and numbers in any order. Samples pass validation.
#include <string_view>

#include "flightmodel/bridges/bridge.hpp"
#include "tests/fuzz/flown_on.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace yars::flightmodel::bridges;
  JsbsimBridge bridge;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  // 20 lines at most: each costs a flight, and more lines find no further errors.
  for (int line = 0; line < 20 && !text.empty(); ++line) {
    const std::size_t end = text.find('\n') == std::string_view::npos ? text.size() : text.find('\n') + 1;
    const auto sample = bridge.receive(std::as_bytes(std::span(text.substr(0, end))), {});
    if (sample && *sample) fly_on(**sample);
    text.remove_prefix(end);
  }
  return 0;
}
