// Any text as the `--source` of a flight simulator (flightmodel/bridges): an error, or a bridge.
#include <string_view>

#include "flightmodel/bridges/bridge_source.hpp"
#include "lib/error/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto source = yars::flightmodel::bridges::open_bridge({reinterpret_cast<const char*>(data), size});
  if (source) YARS_REQUIRE((source->bridge != nullptr), ==, true);
  return 0;
}
