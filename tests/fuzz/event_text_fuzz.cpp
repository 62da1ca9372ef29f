// Any text as the text of an event: an error, or a valid event. The text made from that event gives the same event.
#include <cstdint>
#include <cstring>
#include <string_view>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/error/error.hpp"

using namespace yars::databuffer;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto event = event_from_text({reinterpret_cast<const char*>(data), size});
  if (!event) return 0;
  YARS_REQUIRE(validate(*event).has_value(), ==, false);
  const auto again = event_from_text(text_of(*event));
  YARS_REQUIRE(again.has_value(), ==, true);
  YARS_REQUIRE(std::memcmp(&*again, &*event, sizeof(*event)), ==, 0);
  return 0;
}
